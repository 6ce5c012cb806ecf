/** The way to whoever plans: questions go there, lines of answers come back. */

/** Why a question was not answered to its end: nobody is there, too much is asked, or it is not wanted. */
export type Loss = "lost" | "busy" | "refused";

export class ChannelError extends Error {
  override name = "ChannelError";
  readonly loss: Loss;

  constructor(loss: Loss, words: string) {
    super(words);
    this.loss = loss;
  }
}

export interface Channel {
  /**
   * Asks. Each line of the answer is handed on as it comes; ends with its last one. `ChannelError` where there is no answer. A question
   * that is aborted ends without a word.
   */
  ask(path: string, question: object, onLine: (line: unknown) => void, signal: AbortSignal): Promise<void>;
}

/** The first line of an answer that has only one; null where it was aborted or empty. */
export async function askOnce(channel: Channel, path: string, question: object, signal: AbortSignal): Promise<unknown> {
  let first: unknown = null;
  await channel.ask(path, question, (line) => {
    first ??= line;
  }, signal);
  return first;
}

/** Time to wait before question number `tries` again [ms]: from 0.3 s to 2 s. */
export function backOff(tries: number): number {
  return Math.min(2000, 300 * 2 ** Math.max(0, Math.min(10, tries)));
}
