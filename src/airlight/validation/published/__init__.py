"""Published light of skies and planets beside ours: numbers with their sources, section by section."""
