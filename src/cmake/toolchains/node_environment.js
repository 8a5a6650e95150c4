// Programs in Node see the environment variables of the process, and read their module from a file: emscripten 3.1.6 takes a Node that has
// fetch() for a browser.
globalThis.fetch = undefined;
Module["preRun"] = [].concat(Module["preRun"] || [], () => Object.assign(ENV, process.env));
