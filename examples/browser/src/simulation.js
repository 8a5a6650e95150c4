// Questions to the worker, each a promise.

async function unpack(base64) {
  const bytes = Uint8Array.from(atob(base64), letter => letter.charCodeAt(0));
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip'));
  return new Response(stream).arrayBuffer();
}

export class Simulation {
  #worker;
  #open = new Map(); // questions without an answer
  #next = 0;

  /** `worker`: its text; `module`: the WebAssembly, gzipped, in base64. */
  constructor({worker, module}) {
    const address = URL.createObjectURL(new Blob([worker], {type: 'text/javascript'}));
    this.#worker = new Worker(address);
    URL.revokeObjectURL(address);
    this.#worker.onmessage = ({data: {id, answer, error}}) => {
      const {resolve, reject} = this.#open.get(id);
      this.#open.delete(id);
      error === undefined ? resolve(answer) : reject(new Error(error));
    };
    this.#worker.onerror = event => {
      event.preventDefault();
      this.#open.forEach(({reject}) => reject(new Error(event.message || 'the worker has ended')));
      this.#open.clear();
    };
    this.started = unpack(module).then(binary => this.ask('start', {binary}, [binary]));
  }

  ask(what, question = {}, transfer = []) {
    const id = this.#next++;
    return new Promise((resolve, reject) => {
      this.#open.set(id, {resolve, reject});
      this.#worker.postMessage({id, what, ...question}, transfer);
    });
  }
}
