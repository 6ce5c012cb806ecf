mod agreement;
mod bounds;
