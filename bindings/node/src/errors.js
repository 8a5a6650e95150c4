// An Error for each status of C.
'use strict';
const { wordBytes } = require('./addon.js');
const { enums, statuses } = require('./structs.js');

class DartsweepError extends Error {
  constructor(message, status, code) {
    super(message);
    this.status = status;
    this.code = code;
  }
}

const classes = { DartsweepError };
const ofStatus = new Map();

function define(name, base, status, code) {
  const type = {
    [name]: class extends base {
      constructor(message) {
        super(message, status, code);
      }
    },
  }[name];
  Object.defineProperty(type.prototype, 'name', { value: name, writable: true, configurable: true });
  classes[name] = type;
  return type;
}

for (const [status, name] of statuses) {
  const value = enums.Status[name];
  ofStatus.set(value, define(`${name}Error`, DartsweepError, value, `DSW_${status}`));
}
define('ClosedError', DartsweepError, enums.Status.NullArgument, 'DSW_CLOSED');

// The stack begins with the caller: the frames of a module of WebAssembly, and of what calls the module, are left out.
function trace(error) {
  const isModule = wordBytes === 4;
  const { stackTraceLimit } = Error;
  if (isModule) Error.stackTraceLimit += 30;
  Error.captureStackTrace(error, errorOf);
  Error.stackTraceLimit = stackTraceLimit;
  if (isModule) error.stack = error.stack.split('\n').filter((line) => !/@emnapi|wasm:/.test(line)).join('\n');
}

function errorOf(status, closed, message) {
  const type = closed ? classes.ClosedError : ofStatus.get(status);
  const error = type ? new type(message) : new DartsweepError(message, status, `DSW_${status}`);
  trace(error);
  return error;
}

module.exports = { classes, errorOf };
