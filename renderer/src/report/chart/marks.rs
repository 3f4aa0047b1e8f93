//! The marks of a panel: lines, areas, heat maps.

use super::palette::{logarithmic, viridis};
use super::scale::Scale;
use super::svg::{Svg, place};
use super::{Heat, Look, Series};
use crate::report::data_uri;
use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};
use std::fmt::Write;

/// Classes of a line that looks so.
pub fn line_class(look: Look) -> String {
    let mut class = format!("line s-{}", look.color);
    if look.dashed {
        class.push_str(" dash");
    }
    if look.bold {
        class.push_str(" bold");
    }
    class
}

/// A line a series; a lone point becomes a short dash.
pub fn lines(svg: &mut Svg, series: &[Series], x: Scale, y: Scale) {
    // The heavier ones last, upon the others.
    let (heavy, light): (Vec<&Series>, Vec<&Series>) = series.iter().partition(|series| series.look.bold);
    for series in light.into_iter().chain(heavy) {
        if series.look.dots {
            dots(svg, series, x, y);
            continue;
        }
        let mut d = path(series.points.iter().map(|&[px, py]| [x.at(px), y.at(py)]));
        if series.points.len() == 1 {
            d.push_str("h6");
        }
        if !d.is_empty() {
            svg.path(&format!("mark-line {}", line_class(series.look)), &d);
        }
    }
}

fn dots(svg: &mut Svg, series: &Series, x: Scale, y: Scale) {
    for &[px, py] in &series.points {
        let (left, middle) = (place(x.at(px) - 3.5), place(y.at(py)));
        let circle = format!("M{left} {middle}a3.5 3.5 0 1 0 7 0a3.5 3.5 0 1 0 -7 0");
        svg.path(&format!("mark-line f-{}", series.look.color), &circle);
    }
}

/// Areas upon each other, from the bottom.
pub fn stack(svg: &mut Svg, parts: &[Series], x: Scale, y: Scale) {
    let mut below = vec![0.0; parts.first().map_or(0, |part| part.points.len())];
    for part in parts {
        let above: Vec<f64> = below.iter().zip(&part.points).map(|(base, point)| base + point[1]).collect();
        let at = |heights: &[f64]| -> Vec<[f64; 2]> {
            part.points.iter().zip(heights).map(|(point, &height)| [x.at(point[0]), y.at(height)]).collect()
        };
        let (mut edge, mut base) = (at(&above), at(&below));
        // A lone frame becomes a bar.
        if let ([top], [bottom]) = (&edge[..], &base[..]) {
            let (top, bottom) = (*top, *bottom);
            edge = vec![[top[0] - 6.0, top[1]], [top[0] + 6.0, top[1]]];
            base = vec![[bottom[0] - 6.0, bottom[1]], [bottom[0] + 6.0, bottom[1]]];
        }
        base.reverse();
        let d = path(edge.into_iter().chain(base));
        if !d.is_empty() {
            svg.path(&format!("mark-area f-{}", part.look.color), &format!("{d}Z"));
        }
        below = above;
    }
}

fn path(points: impl Iterator<Item = [f64; 2]>) -> String {
    let mut d = String::new();
    for (index, [x, y]) in points.enumerate() {
        // Writing to a string cannot fail.
        let _ = write!(d, "{}{} {}", if index == 0 { "M" } else { "L" }, place(x), place(y));
    }
    d
}

/// Counts as an image of one pixel a cell, lowest row at the bottom; a PNG as a `data:` URI.
pub fn heat_image(heat: &Heat) -> String {
    let (width, height) = (heat.counts.len().max(1), heat.rows.max(1));
    let mut pixels = vec![0_u8; width * height * 4];
    for (column, counts) in heat.counts.iter().enumerate() {
        for (row, &count) in counts.iter().take(height).enumerate().filter(|(_, count)| **count > 0) {
            let [r, g, b] = viridis(logarithmic(count, heat.most));
            let pixel = ((height - 1 - row) * width + column) * 4;
            pixels[pixel..pixel + 4].copy_from_slice(&[r, g, b, 255]);
        }
    }
    let mut png = vec![];
    let encoded =
        PngEncoder::new(&mut png).write_image(&pixels, width as u32, height as u32, ExtendedColorType::Rgba8);
    // Writing to memory an image whose buffer fits its size cannot fail.
    debug_assert!(encoded.is_ok());
    data_uri("image/png", &png)
}
