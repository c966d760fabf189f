"""Bundling of ES modules into one."""

from __future__ import annotations

import pytest

from airlight.errors import FileError
from airlight.viewer.browser.modules import join_modules


def test_each_module_stands_once_before_those_that_need_it() -> None:
    # a diamond: both branches import one module, which must come first and only once
    files = {
        "top.js": 'import { l } from "./left.js";\nimport { r } from "./right.js";\n'
        "export default l;",
        "left.js": 'import { f } from "./foot.js";\nexport const l = f;\n',
        "right.js": 'import {\n  f as g,\n} from "./foot.js";\nexport const r = g;\n',
        "foot.js": "export const f = 1;\n",
    }
    joined = join_modules("top.js", files.__getitem__)
    assert [line for line in joined.splitlines() if line.startswith("// ")] == [
        "// foot.js",
        "// left.js",
        "// right.js",
        "// top.js",
    ]
    assert "const { f: g } = module_foot;" in joined
    assert joined.endswith("export default l;")


def test_files_of_several_folders_import_each_other_by_where_they_stand() -> None:
    # two files of the same name in two folders remain two modules
    files = {
        "top.js": 'import { a } from "./one/same.js";\na();',
        "one/same.js": 'import { b } from "../two/same.js";\nexport const a = b;\n',
        "two/same.js": 'import { c } from "./foot.js";\nexport const b = c;\n',
        "two/foot.js": "export const c = 1;\n",
    }
    joined = join_modules("top.js", files.__getitem__)
    assert [line for line in joined.splitlines() if line.startswith("// ")] == [
        "// two/foot.js",
        "// two/same.js",
        "// one/same.js",
        "// top.js",
    ]
    assert "const { b } = module_two_same;" in joined
    assert "const { c } = module_two_foot;" in joined


def test_what_cannot_be_joined_is_refused_by_name() -> None:
    ring = {"a.js": 'import { b } from "./b.js";\n', "b.js": 'import { a } from "./a.js";\n'}
    with pytest.raises(FileError, match=r"a\.js: imports itself by way of a\.js and b\.js"):
        join_modules("a.js", ring.__getitem__)
    star = {"a.js": 'import { b } from "./b.js";\n', "b.js": "export * from './c.js';\n"}
    with pytest.raises(FileError, match=r"b\.js: has a line that cannot be joined: export \*"):
        join_modules("a.js", star.__getitem__)
    with pytest.raises(FileError, match="is not a file of the viewer's web folder"):
        join_modules("nothing.js")
