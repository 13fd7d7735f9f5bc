rootProject.name = "template"
