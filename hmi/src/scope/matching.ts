// Finds channels by typed text.
import type { ChannelInfo } from '../link/rack';

/** Minimum number of letters to search the meanings of channels, too. */
const LETTERS_OF_MEANING = 4;

/** Matches part of the name or the meaning; skips selected channels. */
export function matching(all: readonly ChannelInfo[], chosen: readonly string[], text: string): ChannelInfo[] {
  const part = text.toLowerCase();
  const meant = (one: ChannelInfo): boolean =>
    part.length >= LETTERS_OF_MEANING && one.text.toLowerCase().includes(part);
  return all.filter((one) => !chosen.includes(one.name) && (one.name.toLowerCase().includes(part) || meant(one)));
}
