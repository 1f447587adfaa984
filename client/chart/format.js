// Numbers as the pages of Sundial write them: three digits that count.

export const significant = number => {
  if (number === 0 || !Number.isFinite(number)) return String(number);
  const digits = Math.min(6, Math.max(0, 2 - Math.floor(Math.log10(Math.abs(number)))));
  return Math.abs(number) < 1e-5 ? number.toExponential(1) : number.toFixed(digits);
};

export const percent = share => significant(100 * share) + ' %';

export const bytes = count => {
  const units = ['B', 'KiB', 'MiB', 'GiB'];
  let unit = 0;
  for (; count >= 1024 && unit < 3; ++unit) count /= 1024;
  return (unit === 0 ? count.toFixed(0) : significant(count)) + ' ' + units[unit];
};

// A number of one of the error measures, as the data has it.
export const errorText = (error, value) => `${significant(value * error.factor)} ${error.unit}`;

export const levelText = (error, level) => level === 0 ? 'exact' : `≤ ${+(level * error.factor).toPrecision(6)} ${error.unit}`;

export const timeText = (time, value) => time === 'ms' ? `${significant(value)} ms` : `${significant(value)} ×`;

export const range = (spread, text) => spread[1] === spread[2] ? '' : `[${text(spread[1])}, ${text(spread[2])}]`;

// "sm 2048" for "sm,texels=2048": a name beside a mark, where only one parameter differs.
export const briefName = label => {
  const [method, ...parameters] = label.split(',');
  return parameters.length === 1 ? `${method} ${parameters[0].split('=')[1]}` : label;
};
