# diptych: signatures and docstrings of a Python package, compiled parts included
# SPDX-License-Identifier: LGPL-2.1-or-later
import inspect
import textwrap


def signature(name, thing):
    """The call with its arguments and defaults, without types; None if unknown: pybind11 writes it into the
    docstring."""
    try:
        known = inspect.signature(thing)
    except (TypeError, ValueError):
        return None
    plain = [p.replace(annotation=inspect.Parameter.empty) for p in known.parameters.values() if p.name != "self"]
    call = name + str(inspect.Signature(plain))
    return "\n".join(textwrap.wrap(call, 90, subsequent_indent=" " * (len(name) + 1), break_long_words=False))


def described(name, thing, level):
    """Lines of Markdown of a class with its public members, of a function, method or property."""
    text = inspect.getdoc(thing)
    if not text or name.startswith("_"):
        return []
    call = None if isinstance(thing, property) else signature(name, thing)
    lines = ["#" * level + f" `{name}`", "", textwrap.indent((call + "\n\n" if call else "") + text, "    "), ""]
    if inspect.isclass(thing):
        for member, value in vars(thing).items():
            lines += described(member, value, level + 1)
    return lines


def page(package):
    """Markdown with every documented public class and function of an imported package, in the order of __all__ or of
    the alphabet."""
    lines = []
    for name in getattr(package, "__all__", None) or sorted(vars(package)):
        thing = getattr(package, name)
        if callable(thing):
            lines += described(name, thing, 3)
    return "\n".join(lines)
