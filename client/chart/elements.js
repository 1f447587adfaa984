// Elements of the page.

// element('p', {class: 'hint', onclick: f}, 'text', child...)
export const element = (tag, attributes = {}, ...children) => {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) made.addEventListener(name.slice(2), value);
    else if (value === true) made.setAttribute(name, '');
    else if (value !== false && value !== null && value !== undefined) made.setAttribute(name, value);
  }
  made.append(...children.flat().filter(child => child !== null && child !== undefined));
  return made;
};

export const byId = id => document.getElementById(id);

// A method's mark: {outline, colour, filled}, 12 pixels around 0, 0.
export const markPicture = mark => {
  const space = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(space, 'svg'), path = document.createElementNS(space, 'path');
  for (const [name, value] of Object.entries({class: 'mark', width: 18, height: 18, viewBox: '-9 -9 18 18', 'aria-hidden': true}))
    svg.setAttribute(name, value);
  path.setAttribute('d', mark.outline);
  path.setAttribute('fill', mark.filled ? mark.colour : 'none');
  path.setAttribute('stroke', mark.filled ? 'var(--back)' : mark.colour);
  path.setAttribute('stroke-width', mark.filled ? 1 : 2);
  svg.append(path);
  return svg;
};

export const table = (head, rows) => element('div', {class: 'wide'}, element('table', {},
  element('thead', {}, element('tr', {}, head.map(cell => element('th', {scope: 'col'}, cell)))),
  element('tbody', {}, rows.map(([first, ...rest]) => element('tr', {}, element('th', {scope: 'row'}, first),
    rest.map(cell => element('td', {}, ...[cell].flat())))))));
