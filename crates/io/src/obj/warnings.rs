//! Warnings up to a number that somebody may read.

use crate::error::Warning;
use std::path::Path;

/// Warnings of one model at most.
const MOST: usize = 100;

/// A list that stops growing: a damaged file may give cause for millions.
#[derive(Debug, Default)]
pub(super) struct Warnings {
    list: Vec<Warning>,
    left_out: usize,
}

impl Warnings {
    pub(super) fn push(&mut self, warning: Warning) {
        if self.list.len() < MOST { self.list.push(warning) } else { self.left_out += 1 }
    }

    /// The warnings, and one about those that were left out.
    pub(super) fn finish(mut self, path: &Path) -> Vec<Warning> {
        if self.left_out > 0 {
            self.list.push(Warning::new(path, format!("{} more warnings are left out", self.left_out)));
        }
        self.list
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_list_is_cut_and_says_so() {
        let mut warnings = Warnings::default();
        (0..250).for_each(|i| warnings.push(Warning::new("a", i.to_string())));
        let list = warnings.finish(Path::new("a"));
        assert_eq!(list.len(), MOST + 1);
        assert_eq!(list[MOST].to_string(), "a: 150 more warnings are left out");
    }
}
