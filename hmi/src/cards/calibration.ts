// Words of the calibration command of an IOFLEX02: two bits of code per axis, and KEEP from bit 8 on.

/** Word of CMD with a command for one axis. KEEP is set for the others, so their pending calibrations continue. */
export const wordOfOne = (axis: number, code: number): number => (code << (2 * axis)) | (0xf00 & ~(0x100 << axis));

/** Word of CMD: the commands of axes 0 to 3, which take effect at the same instant. */
export const wordOfAll = (codes: readonly number[]): number =>
  codes.reduce((word, code, axis) => word | (code << (2 * axis)), 0);
