//! The numbers of a chart: CSV for programs, JSON for the page's tooltips.

use super::draw::half_step;
use super::layout::Layout;
use super::{Chart, Column, Heat, Plot, Series};
use crate::report::bins;
use serde_json::{Value, json};
use std::fmt::Display;
use std::io::{self, Write};

impl Chart {
    /// Every number drawn: `row,column,series,x,value` under the chart's own names; the x of a bar is its label.
    ///
    /// # Errors
    /// The writer fails.
    pub fn write_csv(&self, out: impl Write) -> io::Result<()> {
        let mut csv = csv::Writer::from_writer(out);
        let [row, column, series, x] = self.names;
        csv.write_record([row, column, series, x, "value"])?;
        for (row, column, plot) in self.drawn() {
            let head = [self.rows[row].as_str(), self.columns[column].as_str()];
            let mut write = |series: &str, x: &dyn Display, value: &str| {
                csv.write_record([head[0], head[1], series, &x.to_string(), value])
            };
            match plot {
                Plot::Lines(all) | Plot::Stack(super::Stack { parts: all, .. }) => {
                    for series in all {
                        for [x, y] in &series.points {
                            write(&series.name, x, &y.to_string())?;
                        }
                    }
                }
                Plot::Heat(heat) => {
                    for (x, bin, count) in cells(heat) {
                        write(&range(bin), &x, &count.to_string())?;
                    }
                }
                Plot::Bars(bars) => {
                    for bar in bars {
                        for (part, value) in &bar.parts {
                            write(&part.label, &bar.label, &value.to_string())?;
                        }
                    }
                }
                Plot::Columns(columns) => {
                    for Column { label, x, count, .. } in columns {
                        write(label, &x[0], &count.to_string())?;
                    }
                }
                Plot::Picture(picture) => write(&picture.alt, &picture.frame, &picture.file)?,
            }
        }
        csv.flush()
    }

    /// Panels with their places and numbers, for tooltips.
    pub fn hover_data(&self) -> Value {
        let layout = Layout::of(self);
        let panels: Vec<Value> = self
            .drawn()
            .filter_map(|(row, column, plot)| {
                let frame = layout.panel(row, column);
                let x = self.axes(plot, frame).x.domain;
                let mut panel = match plot {
                    Plot::Lines(series) => lines(series, false),
                    Plot::Stack(stack) => lines(&stack.parts, true),
                    Plot::Heat(heat) => heat_data(heat),
                    // Columns have tips of their own.
                    Plot::Bars(_) | Plot::Columns(_) | Plot::Picture(_) => return None,
                };
                panel["at"] = json!([row, column]);
                panel["frame"] = json!(frame.map(|place| (place * 10.0).round() / 10.0));
                panel["domain"] = json!(x);
                panel["title"] = json!([self.rows[row], self.columns[column]]);
                Some(panel)
            })
            .collect();
        json!({ "x": self.x_label, "series": self.names[2], "panels": panels })
    }
}

fn lines(series: &[Series], stacked: bool) -> Value {
    let x_of = |series: &Series| series.points.iter().map(|point| point[0]).collect::<Vec<f64>>();
    let shared = series.first().map(x_of).unwrap_or_default();
    let all: Vec<Value> = series
        .iter()
        .map(|series| {
            let y: Vec<Value> = series.points.iter().map(|point| number(point[1])).collect();
            let mut value = json!({ "name": series.name, "color": series.look.color, "y": y });
            let x = x_of(series);
            if x != shared {
                value["x"] = json!(x);
            }
            value
        })
        .collect();
    json!({ "x": shared, "series": all, "stacked": stacked })
}

fn heat_data(heat: &Heat) -> Value {
    let labels: Vec<String> = (0..heat.rows).map(range).collect();
    let columns: Vec<Vec<u64>> = heat
        .counts
        .iter()
        .map(|counts| {
            let occupied = counts.iter().enumerate().filter(|(_, count)| **count > 0);
            // Row and count by turns: most cells are empty.
            occupied.flat_map(|(row, &count)| [row as u64, count]).collect()
        })
        .collect();
    json!({ "x": heat.x, "half": half_step(&heat.x), "labels": labels, "cells": columns })
}

/// (x, row, clusters) of every cell that is not empty.
fn cells(heat: &Heat) -> impl Iterator<Item = (f64, usize, u64)> {
    heat.x.iter().zip(&heat.counts).flat_map(|(&x, counts)| {
        let occupied = counts.iter().enumerate().filter(|(_, count)| **count > 0);
        occupied.map(move |(row, &count)| (x, row, count))
    })
}

/// The values of a row: `5`, `16-19`.
fn range(row: usize) -> String {
    let (first, last) = (bins::first(row), bins::last(row));
    if first == last { first.to_string() } else { format!("{first}-{last}") }
}

/// Integers as such; others to six digits, which is more than is shown.
fn number(value: f64) -> Value {
    if value.fract() == 0.0 && value.abs() < 9e15 {
        return json!(value as i64);
    }
    json!(crate::report::format::significant(value, 6).parse::<f64>().unwrap_or(value))
}
