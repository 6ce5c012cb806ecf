/** The clock and timers, so that tests can hold them. */
export interface Time {
  /** [ms] */
  now(): number;
  /** Calls back after a time [ms]; the answer takes that back. */
  later(callback: () => void, after_ms: number): () => void;
}

export const BROWSER_TIME: Time = {
  now: () => performance.now(),
  later: (callback, after_ms) => {
    const timer = setTimeout(callback, after_ms);
    return () => clearTimeout(timer);
  },
};
