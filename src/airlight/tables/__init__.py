"""Tables: columns for look-ups, and results kept on disk."""
