"""Robot and world descriptions: documents, their readers, and the model they compile into."""
