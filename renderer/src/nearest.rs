//! "Did you mean": the nearest valid name.

/// The candidate most like `name`, by edits (Damerau-Levenshtein), or `None` where nothing comes near.
/// Hyphen and underscore count as the same letter, and so do upper and lower case.
pub(crate) fn nearest<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let plain = |text: &str| text.to_lowercase().replace('-', "_");
    let name = plain(name);
    candidates
        .into_iter()
        .map(|candidate| (strsim::damerau_levenshtein(&name, &plain(candidate)), candidate))
        .min_by_key(|(edits, _)| *edits)
        .filter(|(edits, candidate)| *edits * 2 <= candidate.chars().count().max(name.chars().count()))
        .map(|(_, candidate)| candidate)
}

/// `; did you mean ...?` where a candidate is near, else the list of all.
pub(crate) fn hint(name: &str, candidates: &[&str]) -> String {
    match nearest(name, candidates.iter().copied()) {
        Some(candidate) => format!("; did you mean `{candidate}`?"),
        None if candidates.is_empty() => String::new(),
        None => format!("; valid are {}", candidates.join(", ")),
    }
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
