// The page's computations on hand-made cases. Run by `node --test`.
import assert from 'node:assert/strict';
import {test} from 'node:test';

import {cheapest, matching, moving, paretoFront, pictured, summarise} from '../../client/chart/analysis.js';
import {significant} from '../../client/chart/format.js';
import {logScale} from '../../client/chart/scale.js';

const one = (id, label, view, ratio, wrong, more = {}) => ({id, label, method: label.split(',')[0], scene: 's', view, light: 'l',
  size: '8x8', ratio: [ratio, ratio * 0.9, ratio * 1.1], ms: [10 * ratio, 9 * ratio, 11 * ratio], m: {wrong, total_bytes: 64},
  passes: [{name: 'store', ms: [ratio, ratio, ratio], work: {}}], ...more});
const failed = (id, label, view) => ({id, label, method: label, scene: 's', view, light: 'l', size: '8x8', error: {code: 'X', message: ''}});

test('one case keeps its quartiles; several span from the least to the most about their mean', () => {
  const [alone] = summarise([one(1, 'a', 'v', 2, 0.1)]);
  assert.deepEqual(alone.ratio, [2, 1.8, 2.2]);
  const [both] = summarise([one(1, 'a', 'v', 1, 0.1), one(2, 'a', 'w', 4, 0.3)]);
  assert.deepEqual(both.ratio.map(significant), ['2.00', '1.00', '4.00']);
  assert.deepEqual(both.m.wrong.map(significant), ['0.200', '0.100', '0.300']);
  assert.equal(both.passes[0].ms, 2.5);
});

test('each case stands alone when asked', () => {
  assert.equal(summarise([one(1, 'a', 'v', 1, 0.1), one(2, 'a', 'w', 4, 0.3)], true).length, 2);
});

test('a method that lacks a case is incomplete and competes for nothing', () => {
  const list = summarise([one(1, 'a', 'v', 1, 0.1), one(2, 'a', 'w', 1, 0.1), one(3, 'b', 'v', 0.5, 0), failed(4, 'b', 'w')]);
  assert.deepEqual(list.map(s => s.complete), [true, false]);
  assert.equal(cheapest(list, 'wrong', 0.5, 'ratio').label, 'a');
  assert.deepEqual(paretoFront(list.map(s => ({x: s.ratio[0], y: s.m.wrong[0], complete: s.complete, label: s.label}))).map(p => p.label), ['a']);
});

test('a case where every method failed is held against none', () => {
  assert(summarise([one(1, 'a', 'v', 1, 0.1), failed(2, 'a', 'w'), failed(3, 'b', 'w')])[0].complete);
});

test('the front has strictly less error with time, and of equal ones the first', () => {
  const points = [[3, 0], [1, 5], [2, 5], [2, 2], [2, 2], [4, 1], [5, 0]].map(([x, y], i) => ({x, y, i, complete: true}));
  assert.deepEqual(paretoFront(points).map(p => p.i), [1, 3, 0]);
  assert.deepEqual(paretoFront([]), []);
});

test('the cheapest method stays within the level in its worst case', () => {
  const list = summarise([one(1, 'fast', 'v', 1, 0), one(2, 'fast', 'w', 1, 0.02), one(3, 'slow', 'v', 3, 0), one(4, 'slow', 'w', 3, 0)]);
  assert.equal(cheapest(list, 'wrong', 0.02, 'ratio').label, 'fast');
  assert.equal(cheapest(list, 'wrong', 0.01, 'ratio').label, 'slow');
  assert.equal(cheapest(list, 'wrong', 0, 'ms').label, 'slow');
  assert.equal(cheapest(list.filter(s => s.label === 'fast'), 'wrong', 0, 'ratio'), null);
});

test('time is drawn of still cases, and of a path only where nothing else is left', () => {
  const still = one(1, 'a', 'v', 1, 0), along = one(2, 'a', 'along w', 1, 0, {stability: {flip_rate: 0, pop: 0}});
  assert.deepEqual(pictured([still, along]), [still]);
  assert.equal(pictured([along, failed(3, 'b', 'along w')]).length, 2);
  assert.deepEqual(moving([still, along]), [along]);
  assert.deepEqual(summarise([along])[0].flip, [0, 0, 0]);
});

test('filters leave what was chosen', () => {
  const cases = [one(1, 'a', 'v', 1, 0), one(2, 'b', 'w', 1, 0)];
  assert.equal(matching(cases, {view: 'w'}).length, 1);
  assert.equal(matching(cases, {view: ''}, new Set(['a'])).length, 1);
  assert.equal(matching(cases, {view: 'v'}, new Set(['a'])).length, 0);
});

test('a logarithmic axis holds its values between whole steps, zeros apart', () => {
  const scale = logScale([0, 0.03, 7]);
  assert(scale.zeros && scale.domain[0] <= 0.03 && scale.domain[1] >= 7);
  assert(scale.ticks.includes(1));
  assert.deepEqual(logScale([0]).domain, [0.01, 1]);
});
