plugins {
    id("org.collektive.kotlin-module")
}
