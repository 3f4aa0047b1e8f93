//! Figures of papers, each from whatever data there are.

use super::chart::Chart;
use super::results::Setting;

/// A figure: drawn from one setting's runs, or a note of what is missing.
#[derive(Debug, Clone)]
pub struct Figure {
    /// Number in its paper, `-2` and so on behind it for further settings: name of its files.
    pub id: String,
    /// One line.
    pub title: String,
    /// What is drawn, and what it was drawn from.
    pub caption: String,
    /// The setting, for people; empty where nothing was measured for it.
    pub setting: String,
    /// The drawing; `None` where there are no data.
    pub chart: Option<Chart>,
}

/// What a paper draws, before data are found for it.
#[derive(Clone, Copy)]
pub struct Wanted<'a> {
    /// See [`Figure::id`].
    pub id: &'a str,
    /// One line.
    pub title: &'a str,
    /// What is drawn.
    pub caption: &'a str,
    /// What it needs, said where it is not there.
    pub missing: &'a str,
}

/// A drawing with the setting it is of and a remark for the caption.
pub struct Drawn<'a> {
    /// The setting.
    pub setting: &'a Setting,
    /// The drawing.
    pub chart: Chart,
    /// Words behind the caption.
    pub remark: String,
}

impl<'a> Wanted<'a> {
    /// The same under another number.
    pub const fn at(self, id: &'a str) -> Self {
        Self { id, ..self }
    }

    /// The same with other needs.
    pub const fn missing(self, missing: &'a str) -> Self {
        Self { missing, ..self }
    }
}

/// One figure a drawing, or one that says what is missing.
pub fn figures(wanted: &Wanted<'_>, drawn: Vec<Drawn<'_>>) -> Vec<Figure> {
    let title = wanted.title.to_owned();
    if drawn.is_empty() {
        let caption = format!("Not enough data: {}.", wanted.missing);
        return vec![Figure { id: wanted.id.into(), title, caption, setting: String::new(), chart: None }];
    }
    let figure = |(index, drawn): (usize, Drawn<'_>)| Figure {
        id: if index == 0 { wanted.id.into() } else { format!("{}-{}", wanted.id, index + 1) },
        title: title.clone(),
        caption: format!("{}{}", wanted.caption, drawn.remark),
        setting: drawn.setting.to_string(),
        chart: Some(drawn.chart),
    };
    drawn.into_iter().enumerate().map(figure).collect()
}
