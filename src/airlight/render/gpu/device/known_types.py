"""Preloading of wgpu's types into cffi's cache of parsed type names.

wgpu allocates structures by type name, which cffi parses in Python: 26 ms for each of about fifty
names, two thirds of the time until a window's first frame. One declaration with all types as
arguments takes as long as two names.
"""

from __future__ import annotations

from typing import Any, Final

#: Number types of which wgpu allocates arrays.
_NUMBERS: Final = ("char", "uint8_t", "uint32_t")
#: Some kinds of types that it allocates.
_KINDS: Final = ("StructType", "EnumType", "PointerType")


def know_types() -> None:
    """Add pointers to wgpu's structures, and arrays, to cffi's cache.

    The cache is not a public interface of cffi; without it this has no effect.
    """
    try:
        from wgpu.backends.wgpu_native import ffi

        table: Any = ffi._parsed_types
        names = [name for name in ffi.list_types()[0] if _kind(ffi, name)]
        structures = [name for name in names if _kind(ffi, name) == "StructType"]
        texts = [f"{name} *" for name in structures]
        arrays = [f"{name}[]" for name in names] + [f"{name} []" for name in _NUMBERS]
        behind = [text.replace("[]", "(*)[]") for text in arrays]
        known = ffi.typeof(f"void(*)({', '.join(texts + behind)})").args
        for text, kind in zip(texts, known, strict=False):
            table.setdefault(text, (kind, False))
        for text, pointer in zip(arrays, known[len(texts) :], strict=True):
            table.setdefault(text, (pointer.item, False))
    except Exception:  # after any failure: only speed is lost
        return


def _kind(ffi: Any, name: str) -> str:
    """Kind of a type: structure, handle or enumeration; empty for others."""
    declared = ffi._parser._declarations.get(f"typedef {name}", (None,))[0]
    kind = type(declared).__name__
    return kind if name.startswith("WGPU") and kind in _KINDS else ""
