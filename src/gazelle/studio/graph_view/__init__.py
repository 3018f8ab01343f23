"""The graph as the page sees it: who is there, what flows, and acting on it."""
