"""Compilation of kernels to intermediate code, inlined by their callers.

Numba compiles every function that a loop reaches to machine code with wrappers for Python and C,
although the loop inlines its intermediate code and optimises it again. Here a kernel that is
compiled for a caller remains intermediate code, optimised once in the loop. If Python calls it, it
is compiled to machine code.

Array indices count from the start: only a negative literal counts from the end. Numba would test
the sign of every index.
"""

from __future__ import annotations

import contextlib
import gc
import threading
from collections.abc import Iterator
from contextlib import AbstractContextManager
from functools import cached_property, partial
from pathlib import Path
from typing import Any, Final

from llvmlite import binding
from numba import types
from numba.core import sigutils
from numba.core.caching import CompileResultCacheImpl, FunctionCache
from numba.core.codegen import JITCodeLibrary
from numba.core.compiler import CompilerBase, DefaultPassBuilder, Flags, compile_result
from numba.core.compiler_lock import global_compiler_lock
from numba.core.compiler_machinery import register_pass
from numba.core.errors import NumbaError
from numba.core.lowering import Lower
from numba.core.registry import CPUDispatcher
from numba.core.typed_passes import AnnotateTypes, InlineOverloads, NativeLowering
from numba.core.untyped_passes import (
    InlineInlinables,
    LiteralPropagationSubPipelinePass,
    LiteralUnroll,
    MakeFunctionToJitFunction,
    WithLifting,
)

from airlight.files.cache_folders import read_trusted
from airlight.kernel.borrowed_references import only_borrows
from airlight.kernel.compiled_files import CompiledFolder, check_files, one_process
from airlight.kernel.prebuilt_cache import prebuilt_cache

#: Word for intermediate code among Numba's words for the forms of a library on disk.
_INTERMEDIATE: Final = "intermediate"

#: Thresholds of garbage collection while a function is compiled.
_COLLECTION: Final = (100_000, 50, 50)

_here = threading.local()


@contextlib.contextmanager
def _for_a_caller() -> Iterator[None]:
    """Context in which this thread compiles for a caller."""
    before = _is_for_a_caller()
    _here.for_a_caller = True
    try:
        yield
    finally:
        _here.for_a_caller = before


def _is_for_a_caller() -> bool:
    return getattr(_here, "for_a_caller", False)


@contextlib.contextmanager
def _rare_collection() -> Iterator[None]:
    """Context with less garbage collection, which takes a tenth of the time of compilation."""
    before = gc.get_threshold()
    gc.set_threshold(*_COLLECTION)
    try:
        yield
    finally:
        gc.set_threshold(*before)


class MachineCode(JITCodeLibrary):
    """Machine code of a function and of its callees."""

    def _optimize_functions(self, ll_module: Any) -> None:
        """Simplify the function itself; Numba also prepares passes for each one that it calls."""
        ll_module.data_layout = self._codegen._data_layout
        for function in ll_module.functions:
            if not function.is_declaration:
                passes, builder = self._codegen._function_pass_manager()
                passes.run(function, builder)


class IntermediateCode(MachineCode):
    """LLVM intermediate code of a function and of its callees."""

    def _optimize_final_module(self) -> None:
        """Leave optimisation to the caller."""

    def _finalize_final_module(self) -> None:
        """Close the library without machine code."""
        self._finalize_dynamic_globals()
        self._finalized = True

    def serialize_using_object_code(self) -> tuple[str, str, bytes]:
        """Name, form and code, for the cache."""
        self._ensure_finalized()
        return self.name, _INTERMEDIATE, self._final_module.as_bitcode()

    @classmethod
    def read(cls, codegen: Any, name: str, code: bytes) -> IntermediateCode:
        """Library from its name and code."""
        library = cls(codegen, name)
        library._final_module = binding.parse_bitcode(code)
        library._finalize_final_module()
        return library


def _from_the_start(kind: Any) -> Any:
    """Type of an index, or of a tuple of indices, with unsigned integers."""
    if isinstance(kind, types.BaseTuple):
        return types.BaseTuple.from_types([_from_the_start(part) for part in kind.types])
    if isinstance(kind, types.IntegerLiteral) and kind.literal_value < 0:
        return types.intp
    if isinstance(types.unliteral(kind), types.Integer):
        return types.uintp
    return kind


class _IndexedFromStart(Lower):
    """Lowering with array indices that count from the start."""

    def lower_getitem(self, resty: Any, expr: Any, value: Any, index: Any, signature: Any) -> Any:
        """Lower ``value[index]``."""
        signature = self._with_index(index, signature)
        return super().lower_getitem(resty, expr, value, index, signature)

    def lower_setitem(self, target_var: Any, index_var: Any, value_var: Any, signature: Any) -> Any:
        """Lower ``target[index] = value``."""
        signature = self._with_index(index_var, signature)
        return super().lower_setitem(target_var, index_var, value_var, signature)

    def _with_index(self, index: Any, signature: Any) -> Any:
        array, _, *others = signature.args
        if not isinstance(array, types.Array):
            return signature
        kind = _from_the_start(self.typeof(index.name))
        return signature.replace(args=(array, kind, *others))


@register_pass(mutates_CFG=True, analysis_only=False)
class _Lowering(NativeLowering):
    """Lowering to machine code, or to intermediate code for a caller."""

    _name = "lowering_for_callers"

    @property
    def lowering_class(self) -> type[Lower]:
        """Class that lowers the statements of a function."""
        return _IndexedFromStart

    def run_pass(self, state: Any) -> bool:
        counting = state.targetctx
        if only_borrows(state):
            state.targetctx = counting.subtarget(enable_nrt=False)
            vars(state.targetctx).pop("nrt", None)  # kept by the copied context
            try:
                return self._lower(state)
            except NumbaError:  # a function of Numba's that makes an array for itself
                state.targetctx = counting
        return self._lower(state)

    def _lower(self, state: Any) -> bool:
        if not _is_for_a_caller():
            state.library = MachineCode(state.targetctx.codegen(), state.func_id.func_qualname)
            state.library.enable_object_caching()
            return bool(super().run_pass(state))
        state.library = IntermediateCode(state.targetctx.codegen(), state.func_id.func_qualname)
        state.flags.no_compile = True
        state.flags.no_cpython_wrapper = True
        state.flags.no_cfunc_wrapper = True
        changed = super().run_pass(state)
        entry_point = object()  # by which Numba finds the code again
        state["cr"] = state["cr"]._replace(cfunc=entry_point)
        state.targetctx.insert_user_function(entry_point, state["cr"].fndesc, [state.library])
        return bool(changed)


class _Flags(Flags):
    """Flags of a function, whose copy is what Numba compares at every call of its own functions."""

    def copy(self) -> Flags:
        """Copy that no longer changes."""
        return _SettledFlags(self)


class _SettledFlags(Flags):
    """Flags that no longer change."""

    @cached_property
    def _all(self) -> dict[str, Any]:
        return dict(super().values())

    def values(self) -> dict[str, Any]:
        """Values of all flags by name."""
        return self._all


class _Compiler(CompilerBase):
    """Numba's passes for compiled functions, with this module's lowering."""

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        self.state.flags = _Flags(self.state.flags)

    def define_pipelines(self) -> list[Any]:
        passes = DefaultPassBuilder.define_nopython_pipeline(self.state)
        passes.passes = [
            (_Lowering if one is NativeLowering else one, text)
            for one, text in passes.passes
            if one not in _UNUSED_PASSES
        ]
        passes.finalize()
        return [passes]


#: Passes for what kernels do not contain: contexts, inner functions, literal arguments and loops;
#: and for a listing of types.
_UNUSED_PASSES: Final = (
    AnnotateTypes,
    WithLifting,
    MakeFunctionToJitFunction,
    InlineInlinables,
    LiteralUnroll,
    LiteralPropagationSubPipelinePass,
    InlineOverloads,
)


class _Files(CompileResultCacheImpl):
    """Compiled functions on disk, in both forms."""

    def __init__(self, py_func: Any, folder: Path) -> None:
        self._locator_classes = [CompiledFolder(folder, py_func.__code__.co_firstlineno)]
        super().__init__(py_func)

    def rebuild(self, target_context: Any, payload: Any) -> Any:
        (name, form, code), *fields = payload
        if form != _INTERMEDIATE:
            return super().rebuild(target_context, payload)
        fndesc, environment, signature, objectmode, lifted, text, reload_init, *_ = fields
        return compile_result(
            target_context=target_context,
            typing_context=target_context.typing_context,
            library=IntermediateCode.read(target_context.codegen(), name, code),
            environment=environment,
            entry_point=object(),
            fndesc=fndesc,
            type_annotation=text,
            signature=signature,
            objectmode=objectmode,
            lifted=lifted,
            reload_init=reload_init,
            referenced_envs=(),
        )


class _Cache(FunctionCache):
    """Cache of compiled functions; functions called from Python require machine code."""

    def __init__(self, py_func: Any, folder: Path, trusted: bool) -> None:
        self._impl_class = partial(_Files, folder=folder)
        super().__init__(py_func)
        check_files(self._cache_file, read_trusted)
        self.trusted = trusted
        self._shipped = prebuilt_cache(py_func, _Files, folder)

    @property
    def _places(self) -> tuple[FunctionCache, ...]:
        own = (self,) if self.trusted else ()
        return own if self._shipped is None else (*own, self._shipped)

    @property
    def is_there(self) -> bool:
        """Whether code of the function is on disk for some types."""
        return any(Path(one._cache_file._index_path).is_file() for one in self._places)

    def has(self, sig: Any, codegen: Any) -> bool:
        """Whether code for these types is on disk, in either form."""
        return any(
            one._index_key(sig, codegen) in one._cache_file._load_index() for one in self._places
        )

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        found = super().load_overload(sig, target_context) if self.trusted else None
        if found is None or (_is_intermediate(found) and not _is_for_a_caller()):
            found = None
            if self._shipped is not None:
                found = self._shipped.load_overload(sig, target_context)
        return found

    def save_overload(self, sig: Any, data: Any) -> None:
        if self.trusted:
            super().save_overload(sig, data)


class CompiledKernel(CPUDispatcher):
    """Compiled function: intermediate code for callers, machine code for Python."""

    def __init__(self, py_func: Any, **options: Any) -> None:
        options = {"nopython": True, "boundscheck": None, **options}
        super().__init__(py_func=py_func, targetoptions=options, pipeline_class=_Compiler)

    def keep_in(self, folder: Path, trusted: bool) -> None:
        """Cache compiled code in a folder.

        Parameters
        ----------
        folder : Path
            Folder, whose last three names are also those in ``prebuilt_cache.PREBUILT``.
        trusted : bool
            Whether only this user can write there; otherwise the folder is not used.
        """
        self._cache = _Cache(self.py_func, folder, trusted)

    @property
    def is_kept(self) -> bool:
        """Whether compiled code is cached on disk."""
        return isinstance(self._cache, _Cache) and self._cache.trusted

    @property
    def on_disk(self) -> bool:
        """Whether compiled code is on disk for some types."""
        return isinstance(self._cache, _Cache) and self._cache.is_there

    def get_call_template(self, args: Any, kws: Any) -> Any:
        """Types of a call by another kernel; compiles for them."""
        with _for_a_caller():
            return super().get_call_template(args, kws)

    def compile(self, sig: Any) -> Any:
        """Compile for a signature, as far as needed and not done before.

        Other processes that need the same code wait.
        """
        types, _ = sigutils.normalize_signature(sig)
        if not _is_for_a_caller() and _is_intermediate(self.overloads.get(tuple(types))):
            del self.overloads[tuple(types)]
        # The compiler's lock comes first: one thread of a process at a time waits for another.
        with global_compiler_lock, self._alone(tuple(types)), _rare_collection():
            return super().compile(sig)

    def _alone(self, types: tuple[Any, ...]) -> AbstractContextManager[None]:
        """Prevent concurrent compilation by other processes, if compilation is needed."""
        cache = self._cache
        if types in self.overloads or not isinstance(cache, _Cache) or not cache.trusted:
            return contextlib.nullcontext()
        self.targetctx.refresh()
        if cache.has(types, self.targetctx.codegen()):
            return contextlib.nullcontext()
        cache._impl.locator.ensure_cache_path()
        return one_process(Path(cache._cache_file._index_path).with_suffix(".lock"))

    def add_overload(self, cres: Any) -> None:
        """Register compiled code; only machine code can be called from Python."""
        if _is_intermediate(cres):
            self.overloads[tuple(cres.signature.args)] = cres
        else:
            super().add_overload(cres)


def _is_intermediate(compiled: Any) -> bool:
    return isinstance(getattr(compiled, "library", None), IntermediateCode)
