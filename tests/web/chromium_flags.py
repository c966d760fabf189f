"""Flags of the headless Chromium."""

from __future__ import annotations

#: Flags: WebGPU on SwiftShader, WebGL2 on Mesa's llvmpipe, no background network access; shaders
#: may take longer to compile than a GPU is allowed to be silent.
FLAGS = (
    "--no-sandbox",
    "--enable-unsafe-webgpu",
    "--use-angle=gl-egl",
    "--ignore-gpu-blocklist",
    "--disable-quic",
    "--no-first-run",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--disable-gpu-watchdog",
)
