"""Pictures and probes of a session, computed by the processor or the GPU."""
