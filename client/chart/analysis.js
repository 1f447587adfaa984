// From cases to marks: filters, means, the Pareto front, and the cheapest method for a level of error.
// Nothing here knows the page, so that tests can call it.

const SHARES = [0.05, 0.02, 0.01, 0.005, 0.002, 0.001, 0.0005, 0];

// factor: from the data's number to the axis's.
export const ERRORS = [
  {key: 'wrong', title: 'wrong pixels', unit: '%', of: 'of pixels with geometry', factor: 100, levels: SHARES},
  {key: 'false_lit', title: 'false lit', unit: '%', of: 'of pixels facing the light', factor: 100, levels: SHARES},
  {key: 'false_shadow', title: 'false shadow', unit: '%', of: 'of pixels facing the light', factor: 100, levels: SHARES},
  {key: 'interior_error', title: 'interior error', unit: '%', of: 'of pixels facing the light', factor: 100,
    levels: SHARES},
  {key: 'mean_abs_error', title: 'mean absolute error', unit: '%', of: 'of full light', factor: 100, levels: SHARES},
  {key: 'edge_p95', title: 'edge error, 95th percentile', unit: 'px', of: '', factor: 1,
    levels: [16, 8, 4, 2, 1, 0.5, 0]},
];

export const FILTERS = ['scene', 'view', 'light', 'size'];

export const distinct = (cases, key) => [...new Set(cases.map(one => one[key]))];

// Map.groupBy, which not every browser has yet.
export const groupBy = (list, keyOf) => {
  const groups = new Map();
  for (const one of list) groups.set(keyOf(one), [...groups.get(keyOf(one)) ?? [], one]);
  return groups;
};

export const configurationOf = one => FILTERS.map(key => one[key]).join('\n');

// `chosen`: of each filter a value or '' for all; `hidden`: a set of methods.
export const matching = (cases, chosen, hidden = new Set()) =>
  cases.filter(one => !hidden.has(one.method) && FILTERS.every(key => !chosen[key] || one[key] === chosen[key]));

// Those along a path, and those that time and error are drawn of: where nothing moves, or all where everything does.
// A path's time and error are of its first frame alone, and not every method need be sent along every path.
export const moving = cases => cases.filter(one => one.stability);
export const pictured = cases => {
  const still = cases.filter(one => !one.stability && !one.error);
  return still.length ? still : cases;
};

const mean = values => values.reduce((sum, value) => sum + value, 0) / values.length;

// Of ratios and times; a zero among them would make it zero.
const geometricMean = values =>
  values.every(value => value > 0) ? Math.exp(mean(values.map(Math.log))) : mean(values);

// [middle, low, high]: one case keeps its quartiles, several span from the least to the most.
const together = (spreads, middle) => {
  if (spreads.length === 1) return spreads[0];
  const medians = spreads.map(spread => spread[0]);
  return [middle(medians), Math.min(...medians), Math.max(...medians)];
};

const passesOf = cases => {
  const sums = new Map();
  for (const one of cases)
    for (const pass of one.passes) {
      const sum = sums.get(pass.name) ?? {name: pass.name, ms: 0, ratio: 0};
      sum.ms += pass.ms[0] / cases.length;
      sum.ratio += one.ms[0] > 0 ? pass.ms[0] * one.ratio[0] / one.ms[0] / cases.length : 0;
      sums.set(pass.name, sum);
    }
  return [...sums.values()];
};

const compare = (a, b) => a < b ? -1 : a > b ? 1 : 0;

// In order of names, one summary a method with its parameters: geometric means of times, means of the rest, over
// the views, lights and sizes that the cases have; or, with `apart`, one a case. `complete`: it was measured
// wherever any was.
export const summarise = (cases, apart = false) => {
  const good = cases.filter(one => !one.error), wanted = new Set(good.map(configurationOf)).size;
  const groups = groupBy(good, one => apart ? one.id : one.label);
  const inOrder = [...groups].sort(([, [a]], [, [b]]) => compare(a.method, b.method) ||
    a.label.length - b.label.length || compare(a.label, b.label));
  return inOrder.map(([key, members]) => {
    const spread = name => together(members.map(one => [one.m[name], one.m[name], one.m[name]]), mean);
    const names = Object.keys(members[0].m);
    const stable = members.filter(one => one.stability);
    return {
      key, cases: members, label: members[0].label, method: members[0].method,
      group: apart ? configurationOf(members[0]) : '',
      complete: apart || new Set(members.map(configurationOf)).size === wanted,
      wanted: apart ? 1 : wanted,
      ratio: together(members.map(one => one.ratio), geometricMean),
      ms: together(members.map(one => one.ms), geometricMean),
      m: Object.fromEntries(names.map(name => [name, spread(name)])),
      flip: stable.length ? together(stable.map(one => Array(3).fill(one.stability.flip_rate)), mean) : null,
      pop: stable.length ? Math.max(...stable.map(one => one.stability.pop)) : null,
      passes: passesOf(members),
    };
  });
};

// What no other point beats in both x and y, in order of x. A point that lacks some of the cases doesn't compete.
export const paretoFront = points => {
  const front = [];
  for (const point of points.filter(p => p.complete).sort((a, b) => a.x - b.x || a.y - b.y))
    if (front.length === 0 || point.y < front.at(-1).y) front.push(point);
  return front;
};

// The least time among the methods whose error stays within the level in every case; null if none does.
export const cheapest = (summaries, error, level, time) => summaries
  .filter(one => one.complete && one[time][0] > 0 && one.m[error][2] <= level)
  .reduce((best, one) => !best || one[time][0] < best[time][0] ? one : best, null);
