//! Colours: Okabe and Ito's (2008) for things, viridis for amounts; each readable by the colour-blind.

use std::fmt::Write;

/// A colour by name; what it is depends on light or dark.
pub type Color = &'static str;

/// Name, on light, on dark.
const COLORS: [(Color, &str, &str); 26] = [
    ("page", "#fdfdfc", "#14171a"),
    ("panel", "#f5f5f2", "#1c2024"),
    ("ink", "#1d2126", "#e6e8ea"),
    ("muted", "#5d646c", "#9aa3ac"),
    ("rule", "#d9dad6", "#363c43"),
    ("accent", "#0072b2", "#56b4e9"),
    ("good", "#00795a", "#2fc497"),
    ("bad", "#b84a00", "#f08b4b"),
    ("black", "#1d2126", "#e6e8ea"),
    ("orange", "#e69f00", "#e69f00"),
    ("sky", "#56b4e9", "#56b4e9"),
    ("green", "#009e73", "#11b587"),
    ("blue", "#0072b2", "#3391d1"),
    ("vermillion", "#d55e00", "#e8722a"),
    ("purple", "#cc79a7", "#d58db5"),
    ("yellow", "#c9b800", "#f0e442"),
    ("grey", "#9aa0a6", "#7d858d"),
    ("q0", "#440154", "#6f6bc4"),
    ("q1", "#472d7b", "#5a80c0"),
    ("q2", "#3b528b", "#4493b8"),
    ("q3", "#2c728e", "#33a4ac"),
    ("q4", "#21918c", "#2fb59a"),
    ("q5", "#28ae80", "#4cc47f"),
    ("q6", "#58b957", "#7ad151"),
    ("q7", "#8fbc2b", "#b5de2b"),
    ("q8", "#c3ae00", "#fde725"),
];

/// Colours of ordered things, from little to much.
const ORDERED: [Color; 9] = ["q0", "q1", "q2", "q3", "q4", "q5", "q6", "q7", "q8"];

/// Colours of things without order.
pub const NAMED: [Color; 9] =
    ["blue", "vermillion", "green", "orange", "purple", "sky", "black", "yellow", "grey"];

/// The colour of thing `index` of `count` ordered ones.
pub fn ordered(index: usize, count: usize) -> Color {
    let last = ORDERED.len() - 1;
    if count <= 1 {
        ORDERED[last / 2]
    } else {
        ORDERED[(index.min(count - 1) * last + (count - 1) / 2) / (count - 1)]
    }
}

/// Custom properties of both themes for the page: `:root{--ink:...}`.
pub fn themes() -> String {
    let block = |pick: fn(&(Color, &'static str, &'static str)) -> &'static str| {
        COLORS.iter().map(|color| format!("--{}:{};", color.0, pick(color))).collect::<String>()
    };
    format!(
        ":root{{color-scheme:light dark;{}}}\n@media (prefers-color-scheme:dark){{:root{{{}}}}}\n",
        block(|color| color.1),
        block(|color| color.2)
    )
}

/// Rules of charts: `.s-NAME` strokes and `.f-NAME` fills with a colour, and those of `chart.css`.
pub fn rules() -> String {
    let mut css = include_str!("chart.css").to_owned();
    for (name, ..) in COLORS {
        // Writing to a string cannot fail.
        let _ = writeln!(css, ".s-{name}{{stroke:var(--{name})}}.f-{name}{{fill:var(--{name})}}");
    }
    css
}

/// [`rules`] with the light colours put in, for programs that know no custom properties.
pub fn plain_rules() -> String {
    COLORS.iter().fold(rules(), |css, (name, light, _)| css.replace(&format!("var(--{name})"), light))
}

/// Stops of viridis (van der Walt and Smith 2015), evenly apart.
pub const VIRIDIS: [[u8; 3]; 9] = [
    [68, 1, 84],
    [71, 45, 123],
    [59, 82, 139],
    [44, 114, 142],
    [33, 145, 140],
    [40, 174, 128],
    [94, 201, 98],
    [173, 220, 48],
    [253, 231, 37],
];

/// Viridis at `fraction` of 0..1, linear between its stops.
pub fn viridis(fraction: f64) -> [u8; 3] {
    let place = fraction.clamp(0.0, 1.0) * (VIRIDIS.len() - 1) as f64;
    let low = (place.floor() as usize).min(VIRIDIS.len() - 2);
    let part = place - low as f64;
    let mix = |channel: usize| {
        let [a, b] = [VIRIDIS[low][channel], VIRIDIS[low + 1][channel]].map(f64::from);
        (a + (b - a) * part).round() as u8
    };
    [mix(0), mix(1), mix(2)]
}

/// The fraction of the colours for a count above 0: logarithmic, 1 at the bottom and `most` at the top.
pub fn logarithmic(count: u64, most: u64) -> f64 {
    if most <= 1 { 1.0 } else { (count.max(1) as f64).ln() / (most as f64).ln() }
}

/// `#rrggbb`.
pub fn hex([r, g, b]: [u8; 3]) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}
