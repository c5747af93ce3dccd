// Windows needs no Wine.
