//! What of a file is not drawn, or not as the file has it: one line a kind, for the user.

/// Kinds in the order they were met.
#[derive(Debug, Default)]
pub(super) struct LeftOut {
    /// What, and how many where that can be counted.
    kinds: Vec<(String, Option<u64>)>,
}

impl LeftOut {
    /// Notes `count` more things of a kind; 0 is nothing.
    pub fn add(&mut self, kind: &str, count: u64) {
        match self.kinds.iter_mut().find(|(known, _)| known == kind) {
            Some((_, total)) => *total = Some(total.unwrap_or_default() + count),
            None if count > 0 => self.kinds.push((kind.to_owned(), Some(count))),
            None => {}
        }
    }

    /// Notes something that cannot be counted; once.
    pub fn note(&mut self, what: String) {
        if self.kinds.iter().all(|(known, _)| *known != what) {
            self.kinds.push((what, None));
        }
    }

    /// What was left out, one line a kind.
    pub fn into_warnings(self) -> Vec<String> {
        let line = |(kind, count): (String, Option<u64>)| match count {
            Some(count) => format!("{kind}: {count}"),
            None => kind,
        };
        self.kinds.into_iter().map(line).collect()
    }
}
