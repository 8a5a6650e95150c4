// The series as charts above one another: a click goes to that time, a drag zooms all, a line follows the playback.
import uPlot from 'uplot';

import {element, label, number} from './format.js';
import {colour} from './theme.js';

const LINES = ['--line-1', '--line-2', '--line-3'];
const LABELS = {
  reached: 'Tip has come',
  vertices: 'Vertices of the catheter',
  contacts: 'Contacts',
  cells_tested_share: 'Share of the cells tested',
  orientation_tests: 'Orientation tests',
  detection_ms: 'detection',
  step_ms: 'step',
};
/** The name of a series for people. */
export function seriesLabel(name) {
  return LABELS[name] ?? label(name);
}

const NOT_CHARTED = ['time', 'verified']; // the axis, and what the strip shows

/** Which series share a chart: all times in ms. */
function groups(series) {
  const names = Object.keys(series).filter(name => !NOT_CHARTED.includes(name));
  const times = names.filter(name => name.endsWith('_ms'));
  const charts = names.filter(name => !times.includes(name)).map(name => ({title: seriesLabel(name), names: [name]}));
  return times.length ? [...charts, {title: 'Time [ms]', names: times}] : charts;
}

export class Charts {
  #charts = [];
  #frame = 0;

  /** `seek` is called with a time. */
  constructor(host, {series, series_about: about, unit}, seek) {
    this.series = series;
    for (const group of groups(series)) {
      const value = element('span', {className: 'value'});
      const box = element('div', {className: 'plot'});
      const title = group.names[0] === 'reached' ? `${group.title} [${unit}]` : group.title;
      const described = group.names.map(name => about?.[name]).filter(Boolean).join(' ');
      host.append(element('figure', {title: described},
          element('figcaption', {}, element('span', {textContent: title}), value), box));
      this.#charts.push({...group, value, box});
    }
    this.#charts.forEach((chart, at) => this.#plot(chart, at === this.#charts.length - 1, seek));
    new ResizeObserver(() => this.#resize()).observe(host);
  }

  #plot(chart, withTimes, seek) {
    const ink = () => colour('--quiet');
    const grid = {stroke: () => colour('--grid'), width: 1};
    const bare = {grid, ticks: {show: false}, stroke: ink, font: '11px system-ui, sans-serif'};
    chart.now = element('div', {className: 'now'});
    chart.plot = new uPlot({
      width: 300,
      height: 90,
      legend: {show: false},
      padding: [6, 16, withTimes ? 0 : 4, 0],
      scales: {x: {time: false}, y: {range: (_, least, most) => [Math.min(0, least ?? 0), most > 0 ? most * 1.06 : 1]}},
      axes: [
        {...bare, size: withTimes ? 24 : 0, gap: 3,
          values: (_, ticks) => ticks.map(tick => withTimes ? `${Number(tick.toPrecision(6))} s` : '')},
        {...bare, size: 52, gap: 4, space: 24, values: (_, ticks) => ticks.map(short)},
      ],
      series: [{}, ...chart.names.map((name, at) => ({
        label: seriesLabel(name),
        stroke: () => colour(LINES[at % LINES.length]),
        width: 1.4,
        points: {show: false},
        fill: chart.names.length === 1 ? () => colour('--fill') : undefined,
      }))],
      cursor: {
        y: false,
        sync: {key: 'time'},
        points: {size: 6},
        drag: {x: true, y: false, setScale: false},
        bind: {dblclick: () => () => this.#zoom(null)},
      },
      hooks: {
        init: [plot => {
          plot.over.append(chart.now);
          plot.over.addEventListener('click', event => {
            const left = event.clientX - plot.over.getBoundingClientRect().left;
            if (plot.select.width < 3) {
              seek(plot.posToVal(left, 'x'));
            }
          });
        }],
        setSelect: [plot => {
          const {left, width} = plot.select;
          if (width >= 3) {
            this.#zoom([plot.posToVal(left, 'x'), plot.posToVal(left + width, 'x')]);
            setTimeout(() => plot.setSelect({left: 0, top: 0, width: 0, height: 0}, false)); // after the click that ends the drag
          }
        }],
        draw: [() => this.#place(chart)], // after any change of size or scale
        setCursor: [plot => this.#tell(chart, plot.cursor.idx ?? this.#frame)],
      },
    }, [this.series.time, ...chart.names.map(name => this.series[name])], chart.box);
  }

  #zoom(range) {
    const times = this.series.time;
    const [min, max] = range ?? [times[0], times[times.length - 1]];
    for (const {plot} of this.#charts) {
      plot.setScale('x', {min, max});
    }
  }

  #tell(chart, at) {
    chart.value.textContent = chart.names.map(name =>
      (chart.names.length > 1 ? `${seriesLabel(name)} ` : '') + number(this.series[name][at])).join(' · ');
  }

  show(frame) {
    this.#frame = frame;
    for (const chart of this.#charts) {
      this.#place(chart);
      this.#tell(chart, chart.plot.cursor.idx ?? frame);
    }
  }

  // Puts the line to the frame's time.
  #place({plot, now}) {
    const left = plot?.valToPos(this.series.time[this.#frame], 'x') ?? -1;
    now.style.transform = `translateX(${left}px)`;
    now.hidden = !(left >= 0 && left <= plot.bbox.width / devicePixelRatio);
  }

  paint() {
    this.#charts.forEach(({plot}) => plot.redraw(false, true));
  }

  #resize() {
    for (const {plot, box} of this.#charts) {
      plot.setSize({width: box.clientWidth, height: box.clientHeight});
    }
  }
}

function short(tick) {
  const size = Math.abs(tick);
  const [scale, letter] = size >= 1e9 ? [1e9, 'G'] : size >= 1e6 ? [1e6, 'M'] : size >= 1e4 ? [1e3, 'k'] : [1, ''];
  return `${Number((tick / scale).toPrecision(6))}${letter}`;
}
