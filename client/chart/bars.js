// Time of every pass, stacked: one bar a method, as a Vega specification.
import {BACK, CONFIG, INK, SOFT} from './theme.js';

const ROW = 28;

// rows: {label, sum, passes: [{name, value, tip}]}, longest last; colours: by pass {colour, ink}; text: of a sum.
export const bars = ({rows, colours, title, width, text}) => {
  const height = ROW * rows.length;
  const parts = rows.flatMap(row => {
    let start = 0;
    return row.passes.map(pass => ({...pass, ...colours[pass.name], label: row.label, start, end: start += pass.value}));
  });
  const longest = Math.max(...rows.map(row => row.sum), 1e-9);
  const nameWidth = Math.min(width * 0.4, 24 + 7 * Math.max(...rows.map(row => row.label.length), 1));
  const bar = width - nameWidth - 90;
  return {
    width: bar, height, padding: {left: nameWidth, top: 6, right: 90, bottom: 50}, autosize: 'none', background: null, config: CONFIG,
    data: [{name: 'parts', values: parts}, {name: 'rows', values: rows.map(row => ({...row, text: text(row.sum)}))}],
    scales: [
      {name: 'x', domain: [0, longest], range: [0, bar]},
      {name: 'y', type: 'band', domain: rows.map(row => row.label), range: [0, height], paddingInner: 0.22, paddingOuter: 0.1},
    ],
    axes: [
      {orient: 'bottom', scale: 'x', title, grid: true, titlePadding: 8, tickCount: 8},
      {orient: 'left', scale: 'y', ticks: false, labelColor: INK, labelFontWeight: 500, labelPadding: 8, labelLimit: nameWidth - 10},
    ],
    marks: [
      {type: 'rect', name: 'bars', from: {data: 'parts'}, encode: {update: {x: {scale: 'x', field: 'start'},
        x2: {scale: 'x', field: 'end'}, y: {scale: 'y', field: 'label'}, height: {scale: 'y', band: 1}, fill: {field: 'colour'}, fillOpacity: {field: 'opacity'},
        stroke: {value: BACK}, strokeWidth: {value: 1}, tooltip: {signal: 'datum'},
        description: {signal: "datum.label + ', ' + datum.name"}}}},
      {type: 'text', from: {data: 'parts'}, interactive: false, encode: {update: {
        x: {signal: "(scale('x', datum.start) + scale('x', datum.end)) / 2"}, y: {scale: 'y', field: 'label', band: 0.5},
        text: {signal: "scale('x', datum.end) - scale('x', datum.start) > 7 * length(datum.name) + 6 ? datum.name : ''"},
        align: {value: 'center'}, baseline: {value: 'middle'}, fill: {field: 'ink'}, fontSize: {value: 11}, fontWeight: {value: 600}}}},
      {type: 'text', from: {data: 'rows'}, interactive: false, encode: {update: {x: {scale: 'x', field: 'sum', offset: 8},
        y: {scale: 'y', field: 'label', band: 0.5}, text: {field: 'text'}, baseline: {value: 'middle'}, fill: {value: SOFT},
        fontSize: {value: 12}}}},
    ],
  };
};
