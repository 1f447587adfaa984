// Colours that follow the reader's light or dark scheme, and the font, for Vega.
export const INK = 'var(--ink)', SOFT = 'var(--soft)', FAINT = 'var(--faint)', BACK = 'var(--back)', ACCENT = 'var(--accent)';

const FONT = 'system-ui, sans-serif';
export const CONFIG = {text: {font: FONT}, axis: {labelFont: FONT, titleFont: FONT, labelFontSize: 12, labelColor: SOFT,
  titleFontSize: 13, titleFontWeight: 500, titleColor: INK, gridColor: FAINT, tickColor: SOFT, domain: false}};
