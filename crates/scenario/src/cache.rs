//! Results that are made once and kept.

use std::sync::{Arc, Mutex, PoisonError};

/// Results by their keys: at most so many; the longest unused one is forgotten first. Clones share them.
#[derive(Debug, Clone)]
pub struct Cache<K, T, const MOST: usize>(Arc<Mutex<Vec<(K, T)>>>);

impl<K, T, const MOST: usize> Default for Cache<K, T, MOST> {
    fn default() -> Self {
        Self(Arc::default())
    }
}

impl<K: PartialEq, T: Clone, const MOST: usize> Cache<K, T, MOST> {
    /// Returns the result of a key, which is made where it is not kept, and becomes the last to be forgotten. No lock is held while it is
    /// made: threads that come at the same time make it, too.
    ///
    /// # Errors
    /// The error of `make`; nothing is kept then.
    pub fn get_or_make<E>(&self, key: K, make: impl FnOnce() -> Result<T, E>) -> Result<T, E> {
        let lock = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        let mut kept = lock();
        if let Some(at) = kept.iter().position(|(of, _)| *of == key) {
            let found = kept.remove(at);
            let result = found.1.clone();
            kept.push(found);
            return Ok(result);
        }
        drop(kept);
        let made = make()?;
        kept = lock();
        // Another thread may have made it meanwhile.
        if kept.iter().all(|(of, _)| *of != key) {
            kept.push((key, made.clone()));
        }
        if kept.len() > MOST {
            kept.remove(0);
        }
        Ok(made)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_cache_is_bounded_and_drops_the_longest_unused_first() {
        let cache = Cache::<usize, (), 64>::default();
        let is_kept = |k: usize| cache.get_or_make(k, || Err(())).is_ok();
        (0..64).for_each(|k| cache.get_or_make::<()>(k, || Ok(())).unwrap());
        assert!(is_kept(0));
        cache.get_or_make::<()>(64, || Ok(())).unwrap();
        assert_eq!(cache.0.lock().unwrap().len(), 64);
        assert!(is_kept(0) && !is_kept(1));
    }
}
