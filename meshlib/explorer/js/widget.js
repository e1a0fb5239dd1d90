// Where a kernel is: an anywidget view of the scene that the kernel sends.

function render({ model, el }) {
  const view = makeView();
  let scene;
  const show = () => scene && view.show(scene, Math.min(model.get("frame"), scene.frames - 1));
  const load = () => {
    const bytes = model.get("atlas");                // a DataView; arrays want aligned memory
    if (!bytes.byteLength) return;
    scene = sceneAt(decode(bytes.buffer.slice(bytes.byteOffset, bytes.byteOffset + bytes.byteLength)), 0);
    show();
  };
  el.append(view.root);
  model.on("change:atlas", load);
  model.on("change:frame", show);
  load();
  return () => (view.stop(), model.off("change:atlas", load), model.off("change:frame", show));
}

export default { render };
