// Layers: what all pictures show.
const main = document.querySelector('main');
const buttons = [...document.querySelectorAll('[data-show]')];
const show = name => {
  main.dataset.layer = name;
  for (const b of buttons) b.setAttribute('aria-pressed', b.dataset.show === name);
};
for (const b of buttons) b.onclick = () => show(b.dataset.show);
for (const image of document.querySelectorAll('.on-reference')) image.src = document.getElementById('reference').src;

// Keys: 1 to 6 choose, holding the space bar flicks to the reference.
let before = null;
addEventListener('keydown', e => {
  if (e.ctrlKey || e.metaKey || e.altKey) return;
  if (buttons[e.key - 1]) show(buttons[e.key - 1].dataset.show);
  if (e.key !== ' ' || e.target.closest('summary')) return;
  e.preventDefault();
  if (before === null) { before = main.dataset.layer; show('reference'); }
});
addEventListener('keyup', e => {
  if (e.key !== ' ' || before === null) return;
  e.preventDefault();
  show(before);
  before = null;
});

// One zoom and place for all pictures, in fractions of a picture.
let zoom = 1, x = 0, y = 0;
const frames = [...document.querySelectorAll('.frame')];
const place = () => {
  x = Math.min(0, Math.max(1 - zoom, x));
  y = Math.min(0, Math.max(1 - zoom, y));
  for (const f of frames) {
    f.firstElementChild.style.transform = `translate(${100 * x}%, ${100 * y}%) scale(${zoom})`;
    f.classList.toggle('close', zoom > 2);
  }
};
for (const f of frames) {
  f.addEventListener('wheel', e => {
    e.preventDefault();
    const box = f.getBoundingClientRect(), u = (e.clientX - box.left) / box.width, v = (e.clientY - box.top) / box.height;
    const next = Math.min(40, Math.max(1, zoom * Math.exp(-e.deltaY / 400)));
    x = u - (u - x) * next / zoom;
    y = v - (v - y) * next / zoom;
    zoom = next;
    place();
  }, {passive: false});
  f.addEventListener('pointerdown', e => f.setPointerCapture(e.pointerId));
  f.addEventListener('pointermove', e => {
    if (!f.hasPointerCapture(e.pointerId)) return;
    x += e.movementX / f.clientWidth;
    y += e.movementY / f.clientHeight;
    place();
  });
  f.addEventListener('dblclick', () => { zoom = 1; x = y = 0; place(); });
}
