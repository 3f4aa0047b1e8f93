//! "Did you mean": the nearest valid name.

/// The valid name most like `name`, by edits (Damerau-Levenshtein), or `None` where nothing comes near.
/// Hyphen and underscore count as the same letter, and so do upper and lower case.
pub(crate) fn nearest<'a>(name: &str, valid: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let plain = |text: &str| text.to_lowercase().replace('-', "_");
    let name = plain(name);
    valid
        .into_iter()
        .map(|other| (strsim::damerau_levenshtein(&name, &plain(other)), other))
        .min_by_key(|(edits, _)| *edits)
        .filter(|(edits, other)| *edits * 2 <= other.chars().count().max(name.chars().count()))
        .map(|(_, other)| other)
}

/// `; did you mean ...?` where a valid name is near, else the list of all.
pub(crate) fn hint(name: &str, valid: &[&str]) -> String {
    match nearest(name, valid.iter().copied()) {
        Some(other) => format!("; did you mean `{other}`?"),
        None if valid.is_empty() => String::new(),
        None => format!("; valid are {}", valid.join(", ")),
    }
}

/// The item of `all` that is called `text`; `what` says what it should be.
///
/// # Errors
/// No item has this name; names the nearest.
pub(crate) fn named<T: Copy + ToString>(text: &str, all: &[T], what: &str) -> Result<T, String> {
    all.iter().find(|item| item.to_string() == text).copied().ok_or_else(|| {
        let names: Vec<String> = all.iter().map(ToString::to_string).collect();
        let names: Vec<&str> = names.iter().map(String::as_str).collect();
        format!("`{text}` is no {what}{}", hint(text, &names))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nearest_ignores_case_and_hyphens_and_keeps_its_distance() {
        let names = ["displaced_volume", "msaa", "runs"];
        assert_eq!(nearest("Displaced-Volume", names), Some("displaced_volume"));
        assert_eq!(nearest("mssa", names), Some("msaa"));
        assert_eq!(nearest("anything", names), None);
        assert_eq!(hint("zzz", &["a", "b"]), "; valid are a, b");
    }
}
