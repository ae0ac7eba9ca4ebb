// Called by scripts/measure/inspect with what to do, how often, and a function for the milliseconds of each time: from the pointer's event until
// the browser has painted the frame that answers it.
const [kind, count, done] = arguments, {inspector} = document.body;
const canvas = document.querySelector(kind === "pixel hover" ? "#image" : "#wire-view"), box = canvas.getBoundingClientRect();
// A path across the middle that comes by another place each time.
const place = i => [box.left + box.width * (0.5 + 0.3 * Math.sin(2.4 * i)), box.top + box.height * (0.5 + 0.3 * Math.cos(1.7 * i))];
const send = (type, [x, y]) => canvas.dispatchEvent(new PointerEvent(type, {clientX: x, clientY: y, pointerId: 1, bubbles: true}));
const painted = () => new Promise(resolve => requestAnimationFrame(() => {
  const channel = new MessageChannel();
  channel.port1.onmessage = resolve;
  channel.port2.postMessage(null);
}));
(async () => {
  const times = [];
  if (kind === "drag") send("pointerdown", place(0));
  for (let i = 1; i <= count; ++i) {
    await painted();
    const begin = performance.now();
    send("pointermove", place(i));
    await painted();
    times.push(performance.now() - begin);
  }
  if (kind === "drag") send("pointerup", place(count));
  done({times, triangle: inspector.shown.triangle});
})();
