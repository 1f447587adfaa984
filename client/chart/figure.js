// A Vega view in its place on the page: drawn anew when what it shows changes, with tooltips, and marks that the
// keyboard reaches.
import {byId, element} from './elements.js';

const views = new Map();  // by id of the place

const showTip = (event, datum) => {
  const tip = byId('tip');
  if (!datum?.tip) { tip.hidden = true; return; }
  tip.replaceChildren(element('strong', {}, datum.tip.title),
    element('dl', {}, datum.tip.lines.flatMap(([name, text, more]) =>
      [element('dt', {}, name), element('dd', {}, text, more ? element('small', {}, ' ' + more) : null)])));
  if (datum.tip.foot) tip.append(element('p', {}, datum.tip.foot));
  tip.hidden = false;
  const box = tip.getBoundingClientRect();
  const x = event.clientX + 16 + box.width > innerWidth ? event.clientX - 16 - box.width : event.clientX + 16;
  const y = Math.min(Math.max(8, event.clientY - 20), innerHeight - box.height - 8);
  tip.style.transform = `translate(${Math.max(8, x)}px, ${y}px)`;
};

// Vega's marks become what the keyboard reaches; it draws them a moment after it is told to.
const reachable = (place, open) => {
  for (const mark of place.querySelectorAll('.dots path')) {
    const datum = mark.__data__.datum;
    mark.setAttribute('tabindex', 0);
    mark.setAttribute('role', 'button');
    mark.addEventListener('keydown', event => {
      if (event.key !== 'Enter') return;
      event.preventDefault();  // or the button that gets the focus is pressed by the same key
      open(datum);
    });
    mark.addEventListener('focus', () => {
      const box = mark.getBoundingClientRect();
      if (mark.matches(':focus-visible')) showTip({clientX: box.right, clientY: box.top}, datum);
    });
    mark.addEventListener('blur', () => showTip(null, null));
  }
};

// `open`: what a click or the Enter key on a mark does with its datum.
export const draw = (id, specification, description, open = null) => {
  const place = byId(id);
  views.get(id)?.finalize();
  const view = new vega.View(vega.parse(specification), {renderer: 'svg', hover: true, container: place, logLevel: vega.Error})
    .description(description)
    .tooltip((handler, event, item, value) => showTip(event, value));
  views.set(id, view);
  if (open) view.addEventListener('click', (event, item) => item?.datum?.key && open(item.datum));
  view.runAsync().then(() => { if (open && views.get(id) === view) reachable(place, open); });
};

export const note = (id, text) => {
  views.get(id)?.finalize();
  views.delete(id);
  byId(id).replaceChildren(element('p', {class: 'hint'}, text));
};
