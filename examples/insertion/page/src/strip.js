// The strip above the slider: how many contacts each frame has, and in red the frames that were not verified.
import {colour} from './theme.js';

export class Strip {
  constructor(canvas, data) {
    this.canvas = canvas;
    this.frames = data.frames;
    this.verified = data.series.verified ?? [];
    new ResizeObserver(() => this.paint()).observe(canvas);
  }

  paint() {
    const ratio = devicePixelRatio;
    const width = this.canvas.width = Math.max(Math.round(this.canvas.clientWidth * ratio), 1);
    const height = this.canvas.height = Math.max(Math.round(this.canvas.clientHeight * ratio), 1);
    const context = this.canvas.getContext('2d');
    const counts = Array.from({length: this.frames.count}, (_, frame) => this.frames.contactCount(frame));
    const most = counts.reduce((most, count) => Math.max(most, count), 1);
    const step = width / Math.max(counts.length - 1, 1);
    const bar = (frame, tall) => context.fillRect((frame - 0.5) * step, height - tall, Math.max(step, ratio), tall);
    context.fillStyle = colour('--fill-strong');
    counts.forEach((count, frame) => bar(frame, height * count / most));
    context.fillStyle = colour('--bad');
    this.verified.forEach((verified, frame) => verified === 0 && bar(frame, height));
  }
}
