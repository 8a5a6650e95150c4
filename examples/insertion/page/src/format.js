// Numbers and names as people read them.

const whole = new Intl.NumberFormat('en');

/** Integers with separators, others with `digits` digits, what is no number as a dash. */
export function number(value, digits = 4) {
  if (typeof value !== 'number' || !Number.isFinite(value)) {
    return '–';
  }
  if (Number.isInteger(value)) {
    return whole.format(value + 0); // no negative zero
  }
  const size = Math.abs(value);
  return size < 1e-3 || size >= 1e7 ? value.toExponential(digits - 1) : Number(value.toPrecision(digits)).toString();
}

export function vector(values, digits = 4) {
  return values.map(value => number(value, digits)).join(', ');
}

/** Any value of a table. */
export function cell(value) {
  return typeof value === 'number' || value === null ? number(value) : String(value);
}

/** A word of the input, as a label: cells_tested_share becomes "Cells tested share". */
export function label(name) {
  const words = name.replaceAll('_', ' ');
  return words.charAt(0).toUpperCase() + words.slice(1);
}

/** Builds an element; `children` are elements or texts. */
export function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}
