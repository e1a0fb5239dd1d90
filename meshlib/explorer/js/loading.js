// How a page begins: atlases are unpacked while it is read, and formulas wait for the explorers.

import { sum } from "./mesh.js";

const GROUP = 60;                                    // formulas at a time

/** Resolved once all cells are there, before scripts that wait for that, MathJax among them.
 * @type {Promise<void>} */
export const parsed = new Promise((resolve) => {
  const check = () => document.readyState !== "loading" && resolve();
  document.addEventListener("readystatechange", check);
  check();
});

/** Undoes base 64 and then gzip. The stream is written and read here, which takes no turn of the
 * event loop: a blob or a response in its place would wait behind all other scripts of the page.
 * @type {(text: string) => Promise<ArrayBuffer>} */
export async function unpacked(text) {
  const { readable, writable } = new DecompressionStream("gzip"), writer = writable.getWriter();
  const reader = readable.getReader(), parts = [];
  writer.write(bytesOf(atob(text)));
  writer.close();
  for (let read = await reader.read(); !read.done; read = await reader.read()) parts.push(read.value);
  return joined(parts).buffer;
}

/** @type {(packed: string) => Uint8Array<ArrayBuffer>} */
function bytesOf(packed) {
  const bytes = new Uint8Array(packed.length);       // by a loop: Uint8Array.from takes seven times as long
  for (let k = 0; k < packed.length; k++) bytes[k] = packed.charCodeAt(k);
  return bytes;
}

/** @type {(parts: Uint8Array[]) => Uint8Array<ArrayBuffer>} */
function joined(parts) {
  const whole = new Uint8Array(sum(parts.map((part) => part.length)));
  let start = 0;
  for (const part of parts) {
    whole.set(part, start);
    start += part.length;
  }
  return whole;
}

/** MathJax, which keeps a page busy for long, begins once the explorers can be seen, and takes one
 * group of formulas after the other, so that controls answer in between.
 * @type {(opened: Promise<void>[]) => Promise<void>} */
export async function typesetAfter(opened) {
  await parsed;
  const settings = window.MathJax;
  if (!settings || settings.version) return;         // the page has no formulas, or MathJax has begun
  settings.startup = { pageReady: async () => {
    await Promise.allSettled(opened).then(pause);
    const formulas = Array.from(document.querySelectorAll(".math"));
    for (let k = 0; k < formulas.length; k += GROUP) {
      await window.MathJax.typesetPromise(formulas.slice(k, k + GROUP)).then(pause);
    }
    return window.MathJax.startup.defaultPageReady(); // formulas elsewhere
  } };
}

/** Resolved once the page has been painted and waiting work is done; a hidden page is not painted.
 * @type {() => Promise<void>} */
const pause = () => new Promise((resolve) => {
  if (document.hidden) setTimeout(resolve);
  else requestAnimationFrame(() => setTimeout(resolve));
});
