"""Translated shaders are used only with the text that they were made of."""

from __future__ import annotations

from pathlib import Path

import pytest

from airlight.errors import FileError
from airlight.gpu.emit.translated import file_name, translated, with_head


def test_translation_of_another_text_is_refused(tmp_path: Path) -> None:
    text = with_head("sky", "fn f() {}", "#version 300 es\nvoid main() {}", "hand")
    (tmp_path / file_name("sky", "f")).write_text(text, encoding="utf-8")
    assert translated("sky", "f", "fn f() {}", tmp_path) == text
    with pytest.raises(FileError, match=r"sky\.f\.glsl: belongs to another text of sky\.wgsl"):
        translated("sky", "f", "fn f() { }", tmp_path)
    with pytest.raises(FileError, match=r"sky\.g\.glsl: is missing"):
        translated("sky", "g", "fn f() {}", tmp_path)
