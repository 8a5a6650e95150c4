// The addon behind the package, for what only tests call.
'use strict';
const path = require('node:path');

module.exports = require(path.join(path.dirname(require.resolve('dartsweep')), 'dartsweep.node'));
