//! "Did you mean": the known name nearest to an unknown one.

/// The candidate most like `name`, if any is like enough to be worth a suggestion.
///
/// # Source
/// Damerau-Levenshtein distance (`strsim`), at most a third of the longer name, as rustc does; upper and lower case
/// are the same.
pub fn nearest_name<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // A damaged file may hold names of any length; the distance is quadratic in them.
    const LONGEST: usize = 128;
    if name.len() > LONGEST {
        return None;
    }
    let folded = name.to_lowercase();
    candidates
        .into_iter()
        .filter(|candidate| candidate.len() <= LONGEST)
        .filter_map(|candidate| {
            let longer = name.chars().count().max(candidate.chars().count());
            let distance = strsim::damerau_levenshtein(&folded, &candidate.to_lowercase());
            let extends = !candidate.is_empty() && folded.starts_with(&candidate.to_lowercase());
            (distance * 3 <= longer.max(3) || extends).then_some((distance, candidate))
        })
        .min_by_key(|&(distance, _)| distance)
        .map(|(_, candidate)| candidate)
}

/// `did you mean X?`, or `known: A, B, C` when nothing is near and there are few.
pub fn suggestion<'a>(name: &str, candidates: impl IntoIterator<Item = &'a str> + Clone) -> Option<String> {
    const FEW: usize = 12;
    if let Some(near) = nearest_name(name, candidates.clone()) {
        return Some(format!("did you mean {}?", crate::error::quote(near)));
    }
    let known: Vec<_> = candidates.into_iter().map(crate::error::quote).collect();
    (!known.is_empty() && known.len() <= FEW).then(|| format!("known: {}", known.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_finger_is_found() {
        let known = ["width", "height", "samples"];
        assert_eq!(nearest_name("widht", known), Some("width"));
        assert_eq!(nearest_name("Samples", known), Some("samples"));
        assert_eq!(nearest_name("bananas", known), None);
    }

    #[test]
    fn a_name_that_begins_with_a_known_one_is_found() {
        assert_eq!(nearest_name("fov_degree", ["fov", "focus"]), Some("fov"));
    }

    #[test]
    fn of_several_near_names_the_nearest_wins() {
        assert_eq!(nearest_name("wood.pnh", ["food.png", "wood.png"]), Some("wood.png"));
    }

    #[test]
    fn few_candidates_are_listed() {
        assert_eq!(suggestion("zzz", ["point", "spot"]).unwrap(), "known: `point`, `spot`");
        assert_eq!(suggestion("spto", ["point", "spot"]).unwrap(), "did you mean `spot`?");
        assert_eq!(suggestion("zzz", []), None);
    }
}
