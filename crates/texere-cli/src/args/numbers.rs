//! Lengths and points of the command line.

/// A length from its number.
pub(super) fn millimetres(text: &str) -> Result<f32, String> {
    let number = text.parse().ok().filter(|number: &f32| number.is_finite() && *number > 0.0);
    number.ok_or_else(|| "expected a finite number of millimetres above 0".into())
}

/// A point from its numbers.
pub(super) fn point(text: &str) -> Result<[f32; 2], String> {
    let (x, y) = text.split_once(',').ok_or("expected two numbers, such as 12.5,8")?;
    let number = |text: &str| match text.trim().parse::<f32>() {
        Ok(number) if number.is_finite() => Ok(number),
        _ => Err(format!("\"{text}\" is not a number of millimetres")),
    };
    Ok([number(x)?, number(y)?])
}
