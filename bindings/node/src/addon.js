// The addon for this machine, or else the module of WebAssembly, which runs on every machine and in which calls take longer.
'use strict';
const fs = require('node:fs');
const path = require('node:path');

const prebuilds = path.join(__dirname, '..', 'prebuilds');
const addon = path.join(prebuilds, `${process.platform}-${process.arch}`, 'dartsweep.node');

// The module asks for Node-API, which emnapi has in JavaScript. All of this is done when it returns: nothing is compiled later.
function loadModule() {
  const glue = path.join(prebuilds, 'wasm32', 'dartsweep.js');
  if (!fs.existsSync(glue)) throw new Error(`dartsweep has no addon for ${process.platform}-${process.arch}, and no module of WebAssembly`);
  const { createNapiModule } = require('@emnapi/core');
  const { getDefaultContext } = require('@emnapi/runtime');
  const nodeApi = createNapiModule({ context: getDefaultContext(), filename: glue });
  const module = new WebAssembly.Module(fs.readFileSync(glue.replace(/js$/, 'wasm')));
  let instance;
  require(glue)({
    instantiateWasm(imports, receive) {
      const { env, napi, emnapi } = nodeApi.imports;
      instance = new WebAssembly.Instance(module, { ...imports, env: { ...imports.env, ...env, ...napi, ...emnapi } });
      receive(instance);
      return instance.exports;
    },
  });
  nodeApi.init({ instance, module });
  return nodeApi.exports;
}

// DARTSWEEP_ADDON=wasm asks for the module where there is an addon.
const isNative = process.env.DARTSWEEP_ADDON !== 'wasm' && fs.existsSync(addon);

module.exports = {
  native: isNative ? require(addon) : loadModule(),
  wordBytes: isNative ? 8 : 4, // of a pointer and a size_t
};
