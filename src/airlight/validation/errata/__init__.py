"""What the source documents print otherwise, computed."""
