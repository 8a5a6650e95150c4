// Which frame is shown, and playing through them relative to real time. Tells listeners of 'frame' and of 'playing'.

export const SPEEDS = [0.02, 0.05, 0.1, 0.2, 0.5, 1, 2, 5, 10, 20, 50];

export class Player extends EventTarget {
  #last = 0; // when the last picture was drawn, ms
  #clock = 0; // the time that has been played, s

  constructor(frames) {
    super();
    this.frames = frames;
    this.frame = 0;
    this.playing = false;
    const seconds = frames.time[frames.count - 1] - frames.time[0];
    // Real time, unless all would be over at once or last for minutes.
    this.speed = seconds > 4 && seconds < 60 ? 1 : SPEEDS.reduce((best, speed) =>
      Math.abs(Math.log(seconds / speed / 15)) < Math.abs(Math.log(seconds / best / 15)) ? speed : best, 1);
  }

  seek(frame) {
    const wanted = Math.min(Math.max(Math.round(frame), 0), this.frames.count - 1);
    this.#clock = this.frames.time[wanted];
    this.#show(wanted);
  }

  seekTime(time) {
    const frame = this.frames.at(time);
    const later = Math.min(frame + 1, this.frames.count - 1);
    this.seek(time - this.frames.time[frame] < this.frames.time[later] - time ? frame : later);
  }

  toggle() {
    this.playing ? this.pause() : this.play();
  }

  play() {
    if (this.frame === this.frames.count - 1) {
      this.seek(0);
    }
    this.#set(true);
    this.#last = performance.now();
    requestAnimationFrame(now => this.#tick(now));
  }

  pause() {
    this.#set(false);
  }

  /** The next frame (way 1) or the last one before (-1) of which `wanted` holds; stays if there is none. */
  find(way, wanted) {
    for (let frame = this.frame + way; frame >= 0 && frame < this.frames.count; frame += way) {
      if (wanted(frame)) {
        this.pause();
        this.seek(frame);
        return;
      }
    }
  }

  #tick(now) {
    if (!this.playing) {
      return;
    }
    this.#clock += Math.max(now - this.#last, 0) / 1000 * this.speed;
    this.#last = now;
    this.#show(this.frames.at(this.#clock));
    if (this.frame === this.frames.count - 1) {
      this.pause();
    } else {
      requestAnimationFrame(later => this.#tick(later));
    }
  }

  #show(frame) {
    if (frame !== this.frame) {
      this.frame = frame;
      this.dispatchEvent(new Event('frame'));
    }
  }

  #set(playing) {
    if (playing !== this.playing) {
      this.playing = playing;
      this.dispatchEvent(new Event('playing'));
    }
  }
}
