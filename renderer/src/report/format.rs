//! Numbers as people read them.

/// Thousands apart: `1 234 567`, with narrow no-break spaces.
pub fn grouped(value: u64) -> String {
    let digits = value.to_string();
    let mut text = String::new();
    for (place, digit) in digits.chars().enumerate() {
        // Four digits read well together.
        if place > 0 && (digits.len() - place).is_multiple_of(3) && digits.len() > 4 {
            text.push('\u{202f}');
        }
        text.push(digit);
    }
    text
}

/// Short, for ticks: `0`, `250`, `1.5k`, `2M`.
pub fn short(value: f64) -> String {
    let magnitude = value.abs();
    let (scale, suffix) = match magnitude {
        m if m >= 1e9 => (1e9, "G"),
        m if m >= 1e6 => (1e6, "M"),
        m if m >= 1e3 => (1e3, "k"),
        _ => (1.0, ""),
    };
    format!("{}{suffix}", significant(value / scale, 4))
}

/// At most `digits` significant digits and no trailing zeros; integers whole.
pub fn significant(value: f64, digits: i32) -> String {
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".into() } else { value.to_string() };
    }
    let before = value.abs().log10().floor() as i32 + 1;
    let text = format!("{value:.*}", (digits - before).max(0) as usize);
    if !text.contains('.') {
        return text;
    }
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// For tables: grouped where large, four significant digits where small.
pub fn readable(value: f64) -> String {
    if value >= 1000.0 { grouped(value.round() as u64) } else { significant(value, 4) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_read_well() {
        assert_eq!(
            [999, 1000, 10_000, 1_234_567].map(grouped),
            ["999", "1000", "10\u{202f}000", "1\u{202f}234\u{202f}567"]
        );
        assert_eq!(
            [0.0, 250.0, 1500.0, 2e6, 0.05, -1e9].map(short),
            ["0", "250", "1.5k", "2M", "0.05", "-1G"]
        );
        assert_eq!(significant(123_456.0, 4), "123456");
        assert_eq!([0.123_456, 9.9999, 12.5].map(|v| significant(v, 4)), ["0.1235", "10", "12.5"]);
        assert_eq!([0.5, 12_345.6].map(readable), ["0.5", "12\u{202f}346"]);
    }
}
