// The addon behind the package, for what only tests call.
'use strict';
const path = require('node:path');

module.exports = require(path.resolve(path.dirname(require.resolve('dartsweep')), 'addon.js')).native;
