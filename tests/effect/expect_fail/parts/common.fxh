float gX = 1;
