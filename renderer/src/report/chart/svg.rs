//! Writing SVG.

use std::fmt::{Display, Write};

/// A growing SVG document or part of one.
#[derive(Debug, Default)]
pub struct Svg {
    text: String,
}

/// Where a text stands to its place.
#[derive(Debug, Clone, Copy)]
pub enum Anchor {
    /// Begins there.
    Start,
    /// Is centred there.
    Middle,
    /// Ends there.
    End,
}

impl Svg {
    /// Opens an element; `attributes` are (name, value).
    pub fn open(&mut self, tag: &str, attributes: &[(&str, &dyn Display)]) {
        self.tag(tag, attributes);
        self.text.push_str(">\n");
    }

    /// Closes an element.
    pub fn close(&mut self, tag: &str) {
        // Writing to a string cannot fail, here and below.
        let _ = writeln!(self.text, "</{tag}>");
    }

    /// An element without content.
    pub fn empty(&mut self, tag: &str, attributes: &[(&str, &dyn Display)]) {
        self.tag(tag, attributes);
        self.text.push_str("/>\n");
    }

    /// A style sheet of the program's own.
    pub fn style(&mut self, css: &str) {
        let _ = writeln!(self.text, "<style>\n{css}</style>");
    }

    /// An element with text in it.
    pub fn holding(&mut self, tag: &str, attributes: &[(&str, &dyn Display)], content: &str) {
        self.tag(tag, attributes);
        let _ = writeln!(self.text, ">{}</{tag}>", escape(content));
    }

    /// A text at a place.
    pub fn label(&mut self, [x, y]: [f64; 2], anchor: Anchor, class: &str, content: &str) {
        let anchor = match anchor {
            Anchor::Start => "start",
            Anchor::Middle => "middle",
            Anchor::End => "end",
        };
        let (x, y) = (place(x), place(y));
        self.holding("text", &[("x", &x), ("y", &y), ("text-anchor", &anchor), ("class", &class)], content);
    }

    /// A path.
    pub fn path(&mut self, class: &str, d: &str) {
        self.empty("path", &[("class", &class), ("d", &d)]);
    }

    /// A rectangle x, y, width, height.
    pub fn rect(&mut self, class: &str, [x, y, width, height]: [f64; 4]) {
        let [x, y, width, height] = [x, y, width, height].map(place);
        self.empty(
            "rect",
            &[("class", &class), ("x", &x), ("y", &y), ("width", &width), ("height", &height)],
        );
    }

    /// What was written.
    pub fn finish(self) -> String {
        self.text
    }

    fn tag(&mut self, tag: &str, attributes: &[(&str, &dyn Display)]) {
        let _ = write!(self.text, "<{tag}");
        for (name, value) in attributes {
            let _ = write!(self.text, " {name}=\"{}\"", escape(&value.to_string()));
        }
    }
}

/// A coordinate to a tenth of a unit.
pub fn place(value: f64) -> String {
    let text = format!("{value:.1}");
    let text = text.strip_suffix(".0").unwrap_or(&text);
    if text == "-0" { "0".into() } else { text.into() }
}

/// Text as XML and HTML hold it.
pub fn escape(text: &str) -> String {
    text.chars().fold(String::with_capacity(text.len()), |mut out, c| {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            // XML has no place for other control characters.
            c if c.is_control() && !"\n\t\r".contains(c) => out.push('\u{fffd}'),
            c => out.push(c),
        }
        out
    })
}
