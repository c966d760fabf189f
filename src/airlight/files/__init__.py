"""Files: inputs of others, outputs written whole or not at all, manifests, locks, caches."""
