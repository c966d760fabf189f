"""Pictures and probes of a session, by processor or GPU."""
