//! Tables of numbers, and the section of those over several ways of assignment.

use super::text;
use crate::report::format::{readable, significant};
use crate::report::tables::{Row, Table};
use std::fmt::Write;

/// A section with every table.
pub fn section(body: &mut String, tables: &[Table]) {
    super::section(body, "ways", "Ways of assignment");
    tables.iter().for_each(|table| element(body, table));
    body.push_str("</section>\n");
}

/// A table.
pub fn element(body: &mut String, table: &Table) {
    // Writing to a string cannot fail, here and below.
    let _ = writeln!(body, "<figure id=\"table-{}\">\n<h3>{}</h3>", table.id, text(table.title));
    body.push_str("<div class=\"scroll\"><table class=\"ways\">\n<thead><tr>");
    for label in table.labels {
        let _ = write!(body, "<th class=\"lighting\" rowspan=\"2\">{}</th>", text(label));
    }
    for (group, columns) in &table.groups {
        let _ = write!(body, "<th colspan=\"{}\">{}</th>", columns.len(), text(group));
    }
    body.push_str("</tr>\n<tr>");
    for column in table.groups.iter().flat_map(|(_, columns)| *columns) {
        let _ = write!(body, "<th>{}</th>", text(column));
    }
    body.push_str("</tr></thead>\n");
    for block in table.rows.chunk_by(|a, b| a.setting == b.setting) {
        let columns = table.labels.len() + block[0].numbers.len();
        let _ = writeln!(
            body,
            "<tbody><tr class=\"group\"><th colspan=\"{columns}\"><span>{}</span></th></tr>",
            text(&block[0].setting)
        );
        block.iter().for_each(|row| line(body, row));
        body.push_str("</tbody>\n");
    }
    let _ = writeln!(body, "</table></div>\n<figcaption>{}</figcaption>\n</figure>", text(table.caption));
}

fn line(body: &mut String, row: &Row) {
    body.push_str("<tr>");
    for label in &row.labels {
        let _ = write!(body, "<td class=\"lighting\">{}</td>", text(label));
    }
    for number in &row.numbers {
        let _ = write!(body, "<td>{}</td>", number.map_or("–".into(), shown));
    }
    body.push_str("</tr>\n");
}

/// Narrower than elsewhere: there are many columns.
fn shown(number: f64) -> String {
    if number < 100.0 { significant(number, 3) } else { readable(number.round()) }
}
