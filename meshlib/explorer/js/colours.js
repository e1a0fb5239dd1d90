// Colours for values and errors: two tables of matplotlib's, and the levels that bound their bands.

/** @import { Pair } from "./types" */

// Tenths of matplotlib's tables, which readers with any kind of colour vision can follow;
// the last colour of viridis is left out, being too bright for lines on white.
export const VIRIDIS = ["#440154", "#482475", "#414487", "#355f8d", "#2a788e", "#21918c",
                        "#22a884", "#44bf70", "#7ad151", "#bddf26"];
export const CIVIDIS = ["#00224e", "#083370", "#35456c", "#4f576c", "#666970", "#7d7c78",
                        "#948e77", "#aea371", "#c8b866", "#e5cf52", "#fee838"];
const SHADES = 256;                                  // colours of a table once it is interpolated
export const LEVELS = 10;                            // lines of constant value

/** Red, green and blue from 0 to 255.
 * @type {(hex: string) => number[]} */
const channels = (hex) => [1, 3, 5].map((k) => parseInt(hex.slice(k, k + 2), 16));

/** @type {(table: string[]) => number[][]} */
const interpolated = (table) => Array.from({ length: SHADES }, (_, k) => mixed(table, k / (SHADES - 1)));

/** The colour at a share of the length of a table.
 * @type {(table: string[], share: number) => number[]} */
function mixed(table, share) {
  const place = share * (table.length - 1), k = Math.min(Math.floor(place), table.length - 2);
  const [a, b] = [channels(table[k]), channels(table[k + 1])];
  return a.map((c, i) => Math.round(c + (place - k) * (b[i] - c)));
}

export const viridis = interpolated(VIRIDIS);
export const cividis = interpolated(CIVIDIS);

/** The colour at a share, which may lie outside 0 to 1.
 * @type {(table: number[][], share: number) => number[]} */
export const shade = (table, share) => table[Math.round(Math.min(Math.max(share, 0), 1) * (SHADES - 1))];

/** A colour for style sheets, darkened by a factor up to 1.
 * @type {(rgb: number[], light?: number) => string} */
export const css = (rgb, light = 1) => `rgb(${rgb.map((c) => Math.round(light * c)).join(", ")})`;

/** Red, green and blue of a colour that a browser computed.
 * @type {(colour: string) => number[]} */
export const channelsOf = (colour) => (colour.match(/[\d.]+/g) || []).slice(0, 3).map(Number);

/** Where a value lies between limits, from 0 to 1.
 * @type {(value: number, limits: Pair) => number} */
export const shareOf = (value, [low, high]) => (value - low) / (high - low);

/** Values of the lines, away from the limits, where plateaux are.
 * @type {(limits: Pair) => number[]} */
export const levelsOf = ([low, high]) =>
  Array.from({ length: LEVELS }, (_, k) => low + (high - low) * (k + 0.5) / LEVELS);
