// One mark a method over two logarithmic axes, as a Vega specification.
import {logScale} from './scale.js';
import {ACCENT, BACK, CONFIG, FAINT, INK, SOFT} from './theme.js';

const BAND = 44;  // pixels, for zeros
export const PADDING = {left: 74, top: 14, right: 18, bottom: 54};

const axis = (orient, scale, title) => ({
  orient, scale: orient === 'left' ? 'y' : 'x', title, values: scale.ticks, grid: true,
  tickSize: 4, labelPadding: 5, labelOverlap: true, format: '~r', titlePadding: 10,
});

// Where a value lies in pixels, zeros in the middle of their band.
const at = (field, scale, zero) => `datum.${field} > 0 ? scale('${scale}', datum.${field}) : ${zero}`;

const rule = (from, to, horizontal) => ({
  type: 'rule', from: {data: 'points'}, interactive: false,
  encode: {update: horizontal
    ? {x: {field: from}, x2: {field: to}, y: {field: 'py'}, stroke: {value: INK}, strokeOpacity: {value: 0.55}}
    : {y: {field: from}, y2: {field: to}, x: {field: 'px'}, stroke: {value: INK}, strokeOpacity: {value: 0.55}}},
});

const lines = (name, group, encode) => ({
  type: 'group', from: {facet: {name: name + 'One', data: name, groupby: group}}, interactive: false,
  marks: [{type: 'line', name: name + 'Line', from: {data: name + 'One'}, interactive: false,
    encode: {update: {x: {field: 'px'}, y: {field: 'py'}, ...encode}}}],
});

// points: {key, method, name, x, xLow, xHigh, y, yLow, yHigh, tip}; fronts: those on a front, with their `group`;
// marks: by method; x, y: {title}.
export const scatter = ({points, fronts, marks, x, y, width, height}) => {
  const scales = {x: logScale(points.flatMap(p => [p.x, p.xLow, p.xHigh].filter(v => v > 0 || v === p.x))),
    y: logScale(points.flatMap(p => [p.y, p.yLow, p.yHigh].filter(v => v > 0 || v === p.y)))};
  const left = scales.x.zeros ? BAND : 0, bottom = height - (scales.y.zeros ? BAND : 0);
  const zeroX = left / 2, zeroY = height - BAND / 2;
  const formula = (field, scale, as) => ({type: 'formula', as, expr: at(field, scale, scale === 'x' ? zeroX : zeroY)});
  const places = [formula('x', 'x', 'px'), formula('y', 'y', 'py')];
  const spread = [formula('xLow', 'x', 'pxLow'), formula('xHigh', 'x', 'pxHigh'), formula('yLow', 'y', 'pyLow'),
    formula('yHigh', 'y', 'pyHigh')];
  const styled = points.map(p => ({...p, ...marks[p.method]}));
  const joins = styled.filter(p => styled.some(other => other !== p && other.family === p.family && other.method === p.method))
    .sort((a, b) => a.x - b.x);
  const bands = [];
  if (scales.y.zeros) bands.push({x: 0, y: bottom, w: width, h: BAND, tx: -9, ty: zeroY, align: 'right'});
  if (scales.x.zeros) bands.push({x: 0, y: 0, w: left, h: height, tx: zeroX, ty: height + 15, align: 'center'});
  // A budget anywhere right of the last mark of a front still buys that mark.
  const ends = [...new Map(fronts.map(p => [p.group, p])).values()].map(p => ({...p, end: true}));
  return {
    width, height, padding: PADDING, autosize: 'none', background: null,
    config: CONFIG,
    scales: [
      {name: 'x', type: 'log', domain: scales.x.domain, range: [left, width]},
      {name: 'y', type: 'log', domain: scales.y.domain, range: [bottom, 0]},
    ],
    data: [
      {name: 'points', values: styled, transform: [...places, ...spread]},
      {name: 'joins', values: joins, transform: places},
      {name: 'fronts', values: [...fronts, ...ends],
        transform: [...places, {type: 'formula', as: 'px', expr: `datum.end ? ${width} : datum.px`}]},
      {name: 'bands', values: bands},
    ],
    axes: [axis('bottom', scales.x, x.title), axis('left', scales.y, y.title)],
    marks: [
      {type: 'rect', from: {data: 'bands'}, interactive: false, encode: {update: {x: {field: 'x'}, y: {field: 'y'},
        width: {field: 'w'}, height: {field: 'h'}, fill: {value: FAINT}, fillOpacity: {value: 0.45}}}},
      {type: 'text', from: {data: 'bands'}, interactive: false, encode: {update: {x: {field: 'tx'}, y: {field: 'ty'},
        text: {value: '0'}, align: {field: 'align'}, baseline: {value: 'middle'}, fill: {value: SOFT}, fontSize: {value: 12}}}},
      lines('fronts', 'group', {stroke: {value: ACCENT}, strokeWidth: {value: 2}, strokeOpacity: {value: 0.75},
        interpolate: {value: 'step-after'}}),
      lines('joins', 'family', {stroke: {field: 'colour'}, strokeWidth: {value: 1}, strokeDash: {value: [3, 3]},
        strokeOpacity: {value: 0.8}}),
      rule('pxLow', 'pxHigh', true), rule('pyLow', 'pyHigh', false),
      {type: 'symbol', name: 'dots', from: {data: 'points'}, encode: {
        update: {x: {field: 'px'}, y: {field: 'py'}, shape: {field: 'outline'}, size: {value: 4.4},
          fill: {signal: "datum.filled ? datum.colour : 'var(--back)'"},
          stroke: {signal: "datum.filled ? 'var(--back)' : datum.colour"},
          strokeWidth: {signal: 'datum.filled ? 1 : 2'}, cursor: {value: 'pointer'}, tooltip: {signal: 'datum'},
          description: {signal: "datum.name + ', ' + datum.spoken + '; press Enter to open'"}},
        hover: {size: {value: 8}}}},
      {type: 'text', name: 'names', from: {data: 'dots'}, interactive: false, encode: {enter: {text: {field: 'datum.name'},
        fill: {value: INK}, stroke: {value: BACK}, strokeWidth: {value: 3}, fontSize: {value: 12}, fontWeight: {value: 500}}},
        transform: [{type: 'label', size: [width + PADDING.right, height], offset: [4, 5],
          anchor: ['right', 'top', 'bottom', 'left', 'top-right', 'bottom-right', 'top-left', 'bottom-left'],
          avoidMarks: ['dots']}]},
    ],
  };
};
