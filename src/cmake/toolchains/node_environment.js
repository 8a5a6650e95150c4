// Programs in Node see the environment variables of the process.
Module["preRun"] = [].concat(Module["preRun"] || [], () => Object.assign(ENV, process.env));
