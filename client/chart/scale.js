// Logarithmic axes: whole steps of 1, 2 and 5 around the values, and a band of its own for zero.

const step = (value, up) => {
  const decade = 10 ** Math.floor(Math.log10(value)), digit = value / decade;
  return decade * (up ? [1, 2, 5, 10].find(d => digit <= d * 1.000001) : [5, 2, 1].find(d => digit >= d * 0.999999));
};

// {domain, ticks, zeros} for values >= 0; some range where none is above 0.
export const logScale = values => {
  const positive = values.filter(value => value > 0);
  const low = positive.length ? step(Math.min(...positive) / 1.12, false) : 0.01;
  const high = positive.length ? step(Math.max(...positive) * 1.12, true) : 1;
  const digits = high / low <= 500 ? [1, 2, 5] : [1], ticks = [];
  for (let power = Math.floor(Math.log10(low)); 10 ** power <= high * 1.001; ++power)
    for (const digit of digits) {
      const tick = digit * 10 ** power;
      if (tick >= low * 0.999 && tick <= high * 1.001) ticks.push(tick);
    }
  return {domain: [low, high], ticks, zeros: values.some(value => !(value > 0))};
};
