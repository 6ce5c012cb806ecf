//! One value for each branch of a closed form.

use crate::ik::analytic::branch::Label;

/// One value for each branch of a closed form, in the order of [`Label::index`]: eight, or more for an arm with several branches on the same
/// sides.
#[derive(Debug, Clone, PartialEq)]
pub struct Branches<T> {
    eight: [T; 8],
    /// Values of the branches behind the first eight. Where there are none, nothing is allocated.
    more: Vec<T>,
}

impl<T> Branches<T> {
    /// Returns the values in the order of [`Label::index`].
    pub fn iter(&self) -> impl Iterator<Item = &T> {
        self.eight.iter().chain(&self.more)
    }

    /// Returns the values, each with the label of its branch.
    pub fn labelled(&self) -> impl Iterator<Item = (Label, &T)> {
        self.iter().enumerate().map(|(index, value)| (Label::at(index), value))
    }

    /// Returns the value of a branch; `None` where the arm has no such branch.
    #[must_use]
    pub fn get(&self, label: Label) -> Option<&T> {
        match label.index() {
            index @ 0..8 => Some(&self.eight[index]),
            index => self.more.get(index - 8),
        }
    }

    /// Returns a value for each of eight branches.
    #[inline]
    pub(crate) fn of_eight(value: impl FnMut(Label) -> T) -> Self {
        Self {
            eight: Label::EIGHT.map(value),
            more: Vec::new(),
        }
    }

    /// Returns another value for each branch.
    #[inline]
    pub(crate) fn map<U>(&self, mut change: impl FnMut(&T) -> U) -> Branches<U> {
        Branches {
            eight: std::array::from_fn(|index| change(&self.eight[index])),
            more: self.more.iter().map(change).collect(),
        }
    }
}

impl<T> From<([T; 8], Vec<T>)> for Branches<T> {
    /// Takes the branches with number 0, and behind them those with number 1, 2 and so on, eight of each.
    fn from((eight, more): ([T; 8], Vec<T>)) -> Self {
        Self { eight, more }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_closed_form_may_have_sixteen_branches() {
        let sixteen = Branches::from(([0, 1, 2, 3, 4, 5, 6, 7], (8..16).collect()));
        assert!(
            sixteen
                .labelled()
                .all(|(label, k)| label.index() == *k && sixteen.get(label) == Some(k))
        );
        let doubled = sixteen.map(|k| 2 * k);
        let last = Label::EIGHT[7].numbered(1);
        assert_eq!((doubled.get(last), doubled.iter().count()), (Some(&30), 16));
        assert_eq!(last.to_string(), "back down flipped 2");
        assert_eq!(Branches::of_eight(Label::index).get(last), None);
    }
}
