// Channels by a typed text.
import type { ChannelInfo } from '../link/rack';

/** From so many letters on they are looked for in the meanings of channels, too. */
const LETTERS_OF_MEANING = 4;

/** Part of the name, or of the meaning; without the channels that are chosen already. */
export function matching(all: readonly ChannelInfo[], chosen: readonly string[], text: string): ChannelInfo[] {
  const part = text.toLowerCase();
  const meant = (one: ChannelInfo): boolean =>
    part.length >= LETTERS_OF_MEANING && one.text.toLowerCase().includes(part);
  return all.filter((one) => !chosen.includes(one.name) && (one.name.toLowerCase().includes(part) || meant(one)));
}
