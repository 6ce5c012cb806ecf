//! Thinning of a list: items that are too near the one before are left out.

/// The first item, each that is far enough from the last one kept, and the last one.
pub(super) fn thinned<T>(all: &[T], is_far: impl Fn(&T, &T) -> bool) -> Vec<&T> {
    let Some((end, before)) = all.split_last() else {
        return Vec::new();
    };
    let mut kept: Vec<&T> = Vec::new();
    for item in before {
        if kept.last().is_none_or(|last| is_far(last, item)) {
            kept.push(item);
        }
    }
    kept.push(end);
    kept
}
