// Ids are values: two of the same numbers are equal. A generation of 0 is the null id.
'use strict';

class Id {
  get isNull() {
    return this.generation === 0;
  }

  equals(other) {
    return other?.constructor === this.constructor && Object.keys(this).every((key) => this[key] === other[key]);
  }
}

class IdOfTwo extends Id {
  constructor(index = 0, generation = 0) {
    super();
    this.index = index;
    this.generation = generation;
  }
}

class IdOfThree extends Id {
  constructor(volume = 0, generation = 0, local = 0) {
    super();
    this.volume = volume;
    this.generation = generation;
    this.local = local;
  }
}

module.exports = { Id, IdOfTwo, IdOfThree };
