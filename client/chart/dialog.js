// A mark opened: the pictures of one of its cases, its parameters and its numbers.
import {ERRORS} from './analysis.js';
import {byId, element, markPicture, table} from './elements.js';
import {bytes, errorText, percent, range, significant} from './format.js';

const PICTURES = [['picture', 'Picture'], ['error', 'Errors'], ['plan', 'Plan']];

const list = pairs => element('dl', {class: 'facts'}, pairs.map(([name, text, more]) => element('div', {},
  element('dt', {}, name), element('dd', {}, text, more ? element('small', {}, ' ' + more) : null))));

// Pictures are text in the page until someone looks: a URI, or a drawing.
const sourceOf = id => {
  const text = byId(id).textContent;
  return text.startsWith('data:') ? text : 'data:image/svg+xml,' + encodeURIComponent(text);
};

const pictures = one => element('div', {class: 'pictures'}, PICTURES.map(([key, title]) => element('figure', {},
  element('figcaption', {}, element('strong', {}, title)),
  one.images[key] ? element('img', {src: sourceOf(one.images[key]), alt: `${title} of ${one.label}`})
    : element('p', {class: 'missing'}, 'not kept; sundial sweep --images keeps it'))));

const numbers = one => list([
  ...ERRORS.map(error => [error.title, errorText(error, one.m[error.key])]),
  ['edge error p50, max', `${significant(one.m.edge_p50)}, ${significant(one.m.edge_max)} px`],
  ['texel p50, p95', `${significant(one.m.texel_p50)}, ${significant(one.m.texel_p95)} px`],
  ['texels used', percent(one.m.utilisation)],
  ['store', bytes(one.m.store_bytes)], ['total', bytes(one.m.total_bytes)], ['allocated', bytes(one.m.allocated_bytes)],
  ['frame', `${significant(one.ms[0])} ms`, range(one.ms, significant)],
  ['ratio to ' + one.baseline, significant(one.ratio[0]), range(one.ratio, significant)],
  ...(one.stability ? [['flip rate', percent(one.stability.flip_rate)], ['pop', percent(one.stability.pop)],
    ['texel jump', significant(one.stability.texel_jump)], ['points wrong', percent(one.stability.wrong_rate)],
    ['points, frames', `${one.stability.points}, ${one.stability.frames}`]] : []),
]);

const passes = one => {
  const counts = [...new Set(one.passes.flatMap(pass => Object.keys(pass.work)))];
  return table(['pass', 'ms', ...counts.map(name => name.replaceAll('_', ' '))], one.passes.map(pass => [pass.name,
    [significant(pass.ms[0]), element('small', {}, ' ' + range(pass.ms, significant))],
    ...counts.map(name => pass.work[name] === undefined ? '–' : pass.work[name].toLocaleString('en'))]));
};

let shown = [], place = 0;

const show = (mark, index) => {
  place = (index + shown.length) % shown.length;
  const one = shown[place];
  const turn = (by, name) => {
    show(mark, place + by);
    byId('dialog').querySelector(`[aria-label="${name}"]`).focus();  // the button was made anew
  };
  const move = (by, text, name) => element('button', {onclick: () => turn(by, name), 'aria-label': name}, text);
  byId('dialog-body').replaceChildren(
    element('h2', {}, markPicture(mark), ' ', one.label),
    element('p', {class: 'hint'}, [one.scene, one.view, one.light, one.size.replace('x', ' × ')].join(' · ')),
    shown.length > 1 ? element('p', {class: 'turn'}, move(-1, '←', 'previous case'), ` case ${place + 1} of ${shown.length} `,
      move(1, '→', 'next case')) : '',
    pictures(one),
    element('h3', {}, 'Numbers'), numbers(one),
    element('h3', {}, 'Parameters'),
    Object.keys(one.parameters).length ? list(Object.entries(one.parameters)) : element('p', {class: 'hint'}, 'none'),
    one.passes.length ? element('h3', {}, 'Passes') : '', one.passes.length ? passes(one) : '',
    element('p', {class: 'hint'}, `case ${one.id} · ${one.device} · plan of ${one.plan_views} views`));
};

export const openCases = (cases, mark) => {
  shown = cases;
  show(mark, 0);
  const dialog = byId('dialog');
  dialog.onkeydown = e => {
    if (shown.length > 1 && e.key === 'ArrowLeft') show(mark, place - 1);
    if (shown.length > 1 && e.key === 'ArrowRight') show(mark, place + 1);
  };
  dialog.onclick = e => { if (e.target === dialog) dialog.close(); };  // beside it
  byId('tip').hidden = true;
  dialog.showModal();
  dialog.scrollTop = 0;
};
