// The report: controls, and what they redraw.
import {ERRORS, FILTERS, distinct, groupBy, matching, moving, paretoFront, pictured, summarise} from './analysis.js';
import {bars} from './bars.js';
import {openCases} from './dialog.js';
import {byId, element, markPicture} from './elements.js';
import {draw, note} from './figure.js';
import {briefName, bytes, errorText, percent, range, significant, timeText} from './format.js';
import {PADDING, scatter} from './scatter.js';
import {drawCheapest, drawFailed, drawFlips, drawNumbers, drawPasses} from './tables.js';

const data = JSON.parse(byId('data').textContent);
const cases = data.cases, marks = data.marks;
const state = {error: 'wrong', time: 'ratio', memory: 'total_bytes', apart: false, hidden: new Set(),
  chosen: Object.fromEntries(FILTERS.map(key => [key, '']))};
state.chosen.scene = cases[0].scene;  // a cloud of all scenes says little at first

const open = summary => openCases(summary.cases, marks[summary.method]);

// What a point is called and tells.
const tipOf = (one, error) => ({
  title: one.label,
  lines: [
    [error.title, errorText(error, one.m[error.key][0]), range(one.m[error.key], value => errorText(error, value))],
    ['ratio to baseline', significant(one.ratio[0]), range(one.ratio, significant)],
    ['frame', significant(one.ms[0]) + ' ms', range(one.ms, significant)],
    ['memory, store', `${bytes(one.m.total_bytes[0])}, ${bytes(one.m.store_bytes[0])}`],
    ...(one.flip ? [['flip rate', percent(one.flip[0]), range(one.flip, percent)]] : []),
  ],
  foot: one.cases.length === 1 ? `${one.cases[0].scene} · ${one.cases[0].view} · ${one.cases[0].light}; brackets: quartiles`
    : `mean of ${one.cases.length}${one.complete ? '' : ' of ' + one.wanted} cases; brackets: least and most`,
});

const pointsOf = (summaries, error, xOf, yOf) => summaries.filter(one => xOf(one) && yOf(one)).map(one => {
  const [x, xLow, xHigh] = xOf(one), [y, yLow, yHigh] = yOf(one);
  return {key: one.key, method: one.method, family: one.group + one.method, group: one.group, complete: one.complete,
    name: briefName(one.label), summary: one, x, xLow, xHigh, y, yLow, yHigh, tip: tipOf(one, error),
    spoken: `${errorText(error, one.m[error.key][0])} ${error.title}, ${timeText('ratio', one.ratio[0])} the baseline's time`};
});

const scaled = (spread, factor) => spread.map(value => value * factor);

const drawScatter = (id, points, x, y, withFront, height) => {
  if (points.length === 0) return note(id, 'Nothing to draw: no case matches the filters.');
  const fronts = withFront ? [...groupBy(points, p => p.group).values()].flatMap(paretoFront) : [];
  const width = Math.max(240, byId(id).clientWidth - PADDING.left - PADDING.right - 2);
  draw(id, scatter({points, fronts, marks, x: {title: x}, y: {title: y}, width, height}), `${y} against ${x}`,
    datum => open(datum.summary));
};

const timeTitle = () => state.time === 'ms' ? 'frame time, median [ms]' : `frame time ÷ that of ${data.baseline} [ratio]`;

const drawBars = summaries => {
  const rows = summaries.filter(one => one.passes.length).map(one => {
    const passes = data.passes.map(pass => one.passes.find(p => p.name === pass.name)).filter(Boolean).map(pass => ({
      ...pass, value: pass[state.time],
      tip: {title: `${one.label}: ${pass.name}`, lines: [['time', significant(pass.ms) + ' ms'], ['ratio', significant(pass.ratio)]]}}));
    return {label: state.apart ? `${one.label} · ${one.cases[0].view} · ${one.cases[0].light}` : one.label, passes,
      sum: passes.reduce((sum, pass) => sum + pass.value, 0)};
  }).sort((a, b) => a.sum - b.sum);
  drawPasses(rows, data.passes.map(pass => pass.name));
  if (rows.length === 0) return note('passes', 'No passes were timed.');
  const colours = Object.fromEntries(data.passes.map(pass => [pass.name, pass]));
  draw('passes', bars({rows, colours, width: byId('passes').clientWidth - 2, text: value => timeText(state.time, value),
    title: state.time === 'ms' ? 'median time of the passes on the device [ms]' : `time of the passes ÷ a frame of ${data.baseline} [ratio]`}),
    'time of every pass, stacked');
};

const redraw = () => {
  const error = ERRORS.find(one => one.key === state.error);
  const matched = matching(cases, state.chosen, state.hidden), chosen = pictured(matched);
  const summaries = summarise(chosen, state.apart), steadiness = summarise(moving(matched), state.apart);
  const errorTitle = `${error.title} [${error.unit}${error.of ? ' ' + error.of : ''}]`;
  const errorOf = one => scaled(one.m[error.key], error.factor);
  const timeOf = one => one[state.time][0] > 0 ? one[state.time] : null;
  drawScatter('error-time', pointsOf(summaries, error, timeOf, errorOf), timeTitle(), errorTitle, true, 480);
  drawScatter('error-bytes', pointsOf(summaries, error, one => scaled(one.m[state.memory], 2 ** -20), errorOf),
    `${{total_bytes: 'memory', store_bytes: 'memory of the store', allocated_bytes: 'memory set aside'}[state.memory]} [MiB]`,
    errorTitle, true, 380);
  drawScatter('stability', pointsOf(steadiness, error, errorOf, one => scaled(one.flip, 100)), errorTitle,
    'flip rate [% of points and frames]', true, 380);
  drawFlips({summaries: steadiness, marks, open});
  drawBars(summaries);
  drawCheapest({cases: matching(cases, {...state.chosen, scene: ''}, state.hidden), error, time: state.time, marks, open});
  drawNumbers({summaries, error, marks, open});
  drawFailed(matched);
  const count = chosen.filter(one => !one.error).length;
  const apart = matched.filter(one => !chosen.includes(one) && !one.error).length;
  byId('count').textContent = `${summaries.length} marks of ${count} cases` + (apart ? `; ${apart} along a path stand under stability` : '');
};

// Controls.
const options = (pairs, value) => pairs.map(([key, text]) => element('option', {value: key, selected: key === value}, text));

const choice = (label, pairs, value, change) => element('label', {}, element('span', {}, label),
  element('select', {id: 'choose-' + label, onchange: e => { change(e.target.value); redraw(); }},
    options(pairs, value)));

const toggle = (id, label, pairs, get, set) => element('div', {class: 'toggle', id, role: 'group', 'aria-label': label},
  pairs.map(([value, text]) => element('button', {'data-value': value, 'aria-pressed': String(get() === value), onclick: e => {
    set(value);
    for (const button of e.target.parentElement.children) button.setAttribute('aria-pressed', button === e.target);
    redraw();
  }}, text)));

// Views, lights and sizes are those of the chosen scene; a choice that it doesn't have becomes all of them.
const fillFilters = () => {
  for (const key of FILTERS.filter(name => byId('choose-' + name))) {
    const values = distinct(key === 'scene' ? cases : matching(cases, {scene: state.chosen.scene}), key);
    if (!values.includes(state.chosen[key])) state.chosen[key] = '';
    byId('choose-' + key).replaceChildren(...options([['', `all ${values.length}`], ...values.map(v => [v, v])], state.chosen[key]));
  }
};

for (const key of FILTERS)
  if (distinct(cases, key).length > 1)
    byId('choices').append(choice(key, [], '', value => { state.chosen[key] = value; fillFilters(); }));
fillFilters();
byId('choices').append(
  choice('error', ERRORS.map(one => [one.key, one.title]), state.error, value => { state.error = value; }),
  choice('memory', [['total_bytes', 'all it needs'], ['store_bytes', 'the store'], ['allocated_bytes', 'set aside']], state.memory,
    value => { state.memory = value; }),
  toggle('time', 'Times', [['ratio', 'ratio'], ['ms', 'ms']], () => state.time, value => { state.time = value; }),
  toggle('apart', 'Marks', [[false, 'means'], [true, 'each case']], () => state.apart, value => { state.apart = value; }));
byId('methods').append(...Object.keys(marks).map(method => element('label', {}, element('input', {type: 'checkbox', checked: true,
  value: method, onchange: e => { state.hidden[e.target.checked ? 'delete' : 'add'](method); redraw(); }}), markPicture(marks[method]), ' ', method)));
byId('pass-legend').append(...data.passes.map(pass => element('span', {}, element('i', {style: `background:${pass.colour};opacity:${pass.opacity}`}), pass.name)));

for (const id of ['stability-section', 'flips-section']) byId(id).hidden = !cases.some(one => one.stability);

redraw();
let width = innerWidth, timer = 0;
addEventListener('resize', () => {
  if (innerWidth === width) return;
  width = innerWidth;
  clearTimeout(timer);
  timer = setTimeout(redraw, 120);
});
