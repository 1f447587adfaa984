// The tables: the cheapest method for each level of error, all numbers, what failed.
import {FILTERS, cheapest, distinct, groupBy, pictured, summarise} from './analysis.js';
import {byId, element, markPicture, table} from './elements.js';
import {briefName, bytes, errorText, levelText, percent, range, significant, timeText} from './format.js';

const opener = (summary, marks, open, text = summary.label) =>
  element('button', {class: 'plain', onclick: () => open(summary)}, markPicture(marks[summary.method]), ' ', text);

// A row a scene: `cases` are of all scenes.
export const drawCheapest = ({cases, error, time, marks, open}) => {
  const rows = distinct(cases, 'scene').map(scene => {
    const summaries = summarise(pictured(cases.filter(one => one.scene === scene)));
    return [scene, ...error.levels.map(level => {
      const best = cheapest(summaries, error.key, level, time);
      return best ? [opener(best, marks, open, briefName(best.label)), element('small', {class: 'below'},
        `${timeText(time, best[time][0])} · ${bytes(best.m.total_bytes[0])}`)] : element('span', {class: 'none', title: 'no method of the sweep'}, '–');
    })];
  });
  byId('cheapest').replaceChildren(table(['scene', ...error.levels.map(level => levelText(error, level))], rows));
};

export const drawNumbers = ({summaries, error, marks, open}) => {
  const shares = ['wrong', 'false_lit', 'false_shadow', 'interior_error'];
  const extra = shares.includes(error.key) || error.key === 'edge_p95' ? [] : [error];
  const withFlips = summaries.some(one => one.flip);
  const head = ['method', 'cases', 'wrong', 'false lit', 'false shadow', 'interior', ...extra.map(e => e.title), 'edge p95',
    'texel p95', 'used', 'store', 'total', 'frame ms', 'ratio', ...(withFlips ? ['flips'] : [])];
  byId('numbers').replaceChildren(table(head, summaries.map(one => [opener(one, marks, open),
    one.complete ? String(one.cases.length) : `${one.cases.length} of ${one.wanted}`,
    ...shares.map(key => percent(one.m[key][0])), ...extra.map(e => errorText(e, one.m[e.key][0])),
    `${significant(one.m.edge_p95[0])} px`, `${significant(one.m.texel_p95[0])} px`, percent(one.m.utilisation[0]),
    bytes(one.m.store_bytes[0]), bytes(one.m.total_bytes[0]), significant(one.ms[0]),
    [significant(one.ratio[0]), element('small', {}, ' ' + range(one.ratio, significant))],
    ...(withFlips ? [one.flip ? percent(one.flip[0]) : '–'] : [])])));
};

// A row a method, a column a path: what flips over all of it, and at most in one frame.
export const drawFlips = ({summaries, marks, open}) => {
  const all = summaries.flatMap(one => one.cases);
  const named = ['view', 'light', ...['scene', 'size'].filter(key => distinct(all, key).length > 1)];
  const paths = groupBy(all, one => named.map(key => one[key]).join(' · '));
  byId('flips').replaceChildren(table(['method', ...paths.keys()], summaries.map(one => [opener(one, marks, open),
    ...[...paths.values()].map(path => {
      const found = path.find(other => one.cases.includes(other));
      return found ? [percent(found.stability.flip_rate), element('small', {}, `pop ${percent(found.stability.pop)}`)] : '–';
    })])));
};

export const drawFailed = cases => {
  const failed = cases.filter(one => one.error);
  byId('failed-section').hidden = failed.length === 0;
  byId('failed').replaceChildren(table(['method', ...FILTERS, 'code', 'message'],
    failed.map(one => [one.label, ...FILTERS.map(key => one[key]), one.error.code, one.error.message])));
};

// rows: {label, passes: [{name, ms, ratio}]}
export const drawPasses = (rows, names) => byId('passes-numbers').replaceChildren(table(['method', ...names], rows.map(row =>
  [row.label, ...names.map(name => {
    const pass = row.passes.find(one => one.name === name);
    return pass ? [significant(pass.ms), element('small', {}, ` ${significant(pass.ratio)} ×`)] : '–';
  })])));
