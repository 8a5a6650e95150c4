"""Places in C++ where a fault can be put: statements, conditions and first values, and the words in them that operators replace.

It reads tokens, not types. What does not compile is drawn again by plant.py.
"""
import bisect
import re

TOKEN = re.compile(r"""
    (?P<skip>//[^\n]*|/\*.*?\*/|\s+)
  | (?P<line>^[ \t]*\#(?:[^\n\\]|\\.)*)
  | (?P<text>"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*')
  | (?P<number>\.?\d(?:[eEpP][+-]|[\w.'])*)
  | (?P<word>[A-Za-z_]\w*)
  | (?P<sign><=>|<<=|>>=|\.\.\.|->\*|->|::|\+\+|--|<<|<=|>=|==|!=|&&|\|\||[-+*/%&|^]=|.)
""", re.X | re.S | re.M)
PAIRS = {"(": ")", "[": "]", "{": "}"}

# Operators by name: a word or sign, and what takes its place. `<` and `>` are comparisons only between spaces, as clang-format has them.
SWAPS = {
    "boundary": {"<": "<=", "<=": "<", ">": ">=", ">=": ">"},
    "equality": {"==": "!=", "!=": "=="},
    "order": {"<": ">", ">": "<"},
    "logic": {"&&": "||", "||": "&&"},
    "arithmetic": {"+": "-", "-": "+", "*": "+", "/": "*", "%": "/"},
    "assignment": {"+=": "-=", "-=": "+=", "|=": "&=", "&=": "|=", "*=": "+="},
    "extreme": {"min": "max", "max": "min"},
    "truth": {"true": "false", "false": "true"},
    "number": {"0": "1", "1": "0", "2": "1", "3": "2"},
    "way_on": {"break": "continue", "continue": "break"},
}
BINARY = {"<", ">", "+", "-", "*", "/", "%"}


class Token:
    def __init__(self, kind, text, at):
        self.kind, self.text, self.at, self.end, self.match = kind, text, at, at + len(text), None


class Source:
    """Tokens of a file, with brackets matched, and the statements of its functions."""

    def __init__(self, text):
        self.text = text
        self.tokens = [Token(m.lastgroup, m.group(), m.start()) for m in TOKEN.finditer(text) if m.lastgroup not in ("skip", "line")]
        self.starts = [t.at for t in self.tokens]
        stack = []
        for i, token in enumerate(self.tokens):
            if token.kind == "sign" and token.text in PAIRS:
                stack.append(i)
            elif token.kind == "sign" and token.text in PAIRS.values() and stack:
                token.match = stack.pop()
                self.tokens[token.match].match = i
        self.contexts = []  # (kind, first token, one behind the last)
        for i, token in enumerate(self.tokens):
            if token.text == "{" and token.match and self.holds_code(i):
                self.read_block(i + 1, token.match)

    def word(self, i):
        return self.tokens[i].text if 0 <= i < len(self.tokens) else ""

    def holds_code(self, i):
        """A block of a function or of a lambda, or one that follows if, for, else and so on."""
        before = self.word(i - 1)
        while before in ("const", "noexcept", "mutable", "override", "final") or (
                before == ")" and self.word(self.tokens[i - 1].match - 1) == "noexcept"):
            i = i - 1 if before != ")" else self.tokens[i - 1].match
            before = self.word(i - 1)
        if before == ")":
            head = self.word(self.tokens[i - 1].match - 1)
            return head not in ("alignas", "decltype", "sizeof") and not self.is_constant(i)
        return before in ("else", "do", "try")

    def is_constant(self, i):
        """Whether token i belongs to a function that says constexpr or consteval in its head."""
        while i > 0 and self.word(i - 1) not in (";", "}", "{"):
            i -= 1
            if self.word(i) in ("constexpr", "consteval") and self.word(i - 1) != "if":
                return True
        return False

    def read_block(self, at, end):
        """The statements between two braces, and the conditions of if, while and for. Blocks in them are read for themselves."""
        while at < end:
            word = self.word(at)
            if word in ("if", "while", "for", "switch"):
                at = self.read_head(at)
            elif word in ("else", "do", "try", ";", "}"):
                at += 1
            elif word == "{":
                self.read_block(at + 1, self.tokens[at].match)
                at = self.tokens[at].match + 1
            elif word in ("case", "default"):
                while self.word(at) != ":":
                    at += 1
                at += 1
            else:
                at = self.read_statement(at, end)

    def read_head(self, at):
        """`if (...)` and its like: returns where its body begins. A block that follows is read from `holds_code`."""
        word = self.word(at)
        constant = self.word(at + 1) == "constexpr"
        opening = at + 1 + constant
        first, behind = opening + 1, self.tokens[opening].match
        cuts = [i for i in self.at_depth(first, behind) if self.word(i) == ";"]
        declares = any(self.word(i) == "=" for i in self.at_depth(first, behind))
        if word == "for" and len(cuts) == 2:
            self.add("condition", cuts[0] + 1, cuts[1])
        elif word in ("if", "while") and not constant and not cuts and not declares:
            self.add("condition", first, behind)
        body = behind + 1
        return self.tokens[body].match + 1 if self.word(body) == "{" else body

    def read_statement(self, at, end):
        """Returns where the next one begins."""
        stop = next((i for i in self.at_depth(at, end) if self.word(i) == ";"), end)
        first = self.word(at)
        if stop == end or first in ("using", "static", "static_assert", "constexpr", "struct", "enum", "goto", "DSW_ASSERT", "assert"):
            return stop + 1
        equals = next((i for i in self.at_depth(at, stop) if self.word(i) == "="), None)
        if first in ("return", "break", "continue", "throw") or not self.declares(at, stop):
            self.add("statement", at, stop + 1)
        elif equals and self.word(equals + 1) not in ("{", "[") and not any(
                self.word(i) in ("&", ",", "&&") for i in self.at_depth(at, equals)):
            parts = [i for i in self.at_depth(equals, stop) if self.word(i) == ","]
            self.add("value", equals + 1, parts[0] if parts else stop)
        return stop + 1

    def declares(self, at, stop):
        """Whether a statement begins with a type and a name: two words in a row, or a word behind > & * that no operator takes."""
        if self.word(at) in ("const", "auto"):
            return True
        for i in self.at_depth(at, stop):
            if self.word(i) in ("=", "(", "{", "[", ".", "->"):
                return False
            if self.tokens[i].kind == "word" and i > at and (
                    self.tokens[i - 1].kind == "word" or (self.word(i - 1) in (">", "&", "*") and self.word(i - 2) != "")):
                return self.word(at) not in ("delete", "new")
        return False

    def at_depth(self, at, end):
        """Tokens outside of brackets that open between the two."""
        while at < end:
            yield at
            match = self.tokens[at].match
            at = match + 1 if match and match > at else at + 1

    def add(self, kind, first, behind):
        if first < behind:
            self.contexts.append((kind, first, behind))

    def innermost(self, i):
        """The smallest context that has the token."""
        around = [c for c in self.contexts if c[1] <= i < c[2]]
        return min(around, key=lambda c: c[2] - c[1]) if around else None

    def swaps(self, i):
        """(operator, replacement) for a token."""
        token, text = self.tokens[i], self.tokens[i].text
        if token.kind == "text":
            return
        spaced = self.text[token.at - 1] == " " and self.text[token.end:token.end + 1] in (" ", "\n")
        if text in BINARY and not (spaced and (self.tokens[i - 1].kind in ("number", "word") or self.word(i - 1) in (")", "]"))):
            return
        for name, swap in SWAPS.items():
            if text in swap:
                yield name, swap[text]

    def places(self, start, end):
        """Every (operator, context, first and last position, replacement) of the text between two positions."""
        found = []
        for i in range(bisect.bisect_left(self.starts, start), bisect.bisect_left(self.starts, end)):
            context = self.innermost(i)
            if not context:
                continue
            for name, new in self.swaps(i):
                found.append((name, context, self.tokens[i].at, self.tokens[i].end, new))
            kind, first, behind = context
            if i != first:
                continue
            inner = (self.tokens[first].at, self.tokens[behind - 1].end)
            if kind == "condition":
                found.append(("negation", context, *inner, f"!({self.text[slice(*inner)]})"))
            elif kind == "statement" and self.word(first) not in ("return", "throw"):
                found.append(("deletion", context, *inner, ";"))
        return found

    def planted(self, place, number):
        """(start, end, text): what takes the place of the context, with both forms in it."""
        _, (kind, first, behind), start, end, new = place
        begin, stop = self.tokens[first].at, self.tokens[behind - 1].end
        old = self.text[begin:stop]
        other = self.text[begin:start] + new + self.text[end:stop]
        old, other = (re.sub(r"//[^\n]*", "", text).replace("\n", " ") for text in (old, other))  # error messages keep their lines
        lines = "\n" * self.text[begin:stop].count("\n")
        if kind == "statement":
            return begin, stop, f"{{ if (dsw_fault({number})) {{ {other} }} else {{ {old} }} }}{lines}"
        return begin, stop, f"(dsw_fault({number}) ? ({other}) : ({old})){lines}"
