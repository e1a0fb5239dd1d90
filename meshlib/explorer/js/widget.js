// Where a kernel is: an anywidget view of the scene that the kernel sends.

import { decode, sceneAt } from "./atlas.js";
import { makeView } from "./view.js";

/** @import { Model, Scene } from "./types" */

/** Shows the scene of a model in an element of the notebook; returns a function that ends this.
 * @type {(place: { model: Model, el: HTMLElement }) => () => void} */
export function render({ model, el }) {
  const view = makeView();
  /** @type {Scene | undefined} */
  let scene;
  const show = () => {
    if (scene) view.show(scene, Math.min(model.get("frame"), scene.frames - 1));
  };
  const load = () => {
    const bytes = model.get("atlas");                // a DataView; typed arrays need aligned memory
    if (!bytes.byteLength) return;
    scene = sceneAt(decode(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength)), 0);
    show();
  };
  el.append(view.root);
  model.on("change:atlas", load);
  model.on("change:frame", show);
  load();
  return () => {
    view.stop();
    model.off("change:atlas", load);
    model.off("change:frame", show);
  };
}
