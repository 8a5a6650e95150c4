// The addon for this machine, or the module of WebAssembly where there is none. The module runs on every machine; its calls take longer.
'use strict';
const fs = require('node:fs');
const path = require('node:path');

const prebuilds = path.join(__dirname, '..', 'prebuilds');
const machine = `${process.platform}-${process.arch}`;
const addon = path.join(prebuilds, machine, 'dartsweep.node');
const glue = path.join(prebuilds, 'wasm32', 'dartsweep.js');

// The module asks for Node-API, which emnapi has in JavaScript. Loads at once, for `require` returns the functions.
function loadModule() {
  const { createNapiModule } = require('@emnapi/core');
  const { createContext } = require('@emnapi/runtime');
  const context = createContext();
  context.suppressDestroy(); // or nothing could be closed while the process ends
  const nodeApi = createNapiModule({ context, filename: glue });
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

  const bytesOf = (array) => (ArrayBuffer.isView(array) ? new Uint8Array(array.buffer, array.byteOffset, array.byteLength) : new Uint8Array(array));
  const { memory } = instance.exports;
  return {
    native: nodeApi.exports,
    wordBytes: 4, // of a pointer and a size_t
    hooks: {
      // Throw where an array has another size by now.
      read(array, address, size) {
        new Uint8Array(memory.buffer, address, size).set(bytesOf(array));
      },
      write(array, address, size) {
        bytesOf(array).set(new Uint8Array(memory.buffer, address, size));
      },
    },
  };
}

function load() {
  const hasModule = fs.existsSync(glue);
  if (fs.existsSync(addon)) {
    try {
      return { native: require(addon), wordBytes: 8, hooks: {} };
    } catch (error) {
      if (error.code !== 'ERR_DLOPEN_FAILED' || !hasModule) throw error; // it needs glibc, for one
      process.emitWarning(`the addon of dartsweep cannot be loaded, and a module of WebAssembly takes its place: ${error.message}`);
    }
  } else if (!hasModule) {
    throw new Error(`dartsweep has no addon for ${machine}, and no module of WebAssembly`);
  }
  return loadModule();
}

module.exports = load();
