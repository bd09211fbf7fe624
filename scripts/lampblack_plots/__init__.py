"""Reading results of Lampblack and making pictures of them."""
