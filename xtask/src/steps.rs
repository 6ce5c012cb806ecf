//! Steps one after the other, and side by side where that saves time.

use anyhow::{Result, anyhow};

/// One thing that must pass.
pub type Check = fn() -> Result<()>;

/// Runs steps up to the first that fails.
pub fn all(steps: &[Check]) -> Result<()> {
    steps.iter().try_for_each(|step| step())
}

/// Runs steps, and others beside them: crates that compile alone, and tests that wait, leave a core idle. Both run up to their first
/// failure.
pub fn beside(others: &[Check], steps: impl FnOnce() -> Result<()>) -> Result<()> {
    std::thread::scope(|scope| {
        let others = scope.spawn(|| all(others));
        let done = steps();
        if let Err(error) = &done {
            println!("\nFAILED, while other steps go on: {error:#}");
        }
        let others = others.join().map_err(|_| anyhow!("a panic"))?;
        done.and(others)
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use anyhow::bail;

    #[test]
    fn the_failure_of_either_row_is_returned() {
        let fails: Check = || bail!("no");
        let passes: Check = || Ok(());
        assert!(beside(&[passes, passes], || Ok(())).is_ok());
        assert!(beside(&[passes, fails], || Ok(())).is_err());
        assert!(beside(&[passes], || bail!("no")).is_err());
    }
}
