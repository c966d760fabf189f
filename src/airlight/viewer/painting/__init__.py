"""Pictures and probes of a session, computed by the CPU or the GPU."""
