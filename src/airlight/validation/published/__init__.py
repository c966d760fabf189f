"""Published light of skies and planets beside ours: numbers and their sources."""
