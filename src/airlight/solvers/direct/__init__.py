"""The notes' equations as they stand: trapezoids, a gather over the sphere, order by order."""
